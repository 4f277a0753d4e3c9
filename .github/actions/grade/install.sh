#!/bin/sh
# The first step of the action: installs wasmouse with the installer of this repository, unless
# there is one on the PATH and no version was asked for.
#
# TO                   the folder that gets the program, or a link to the one that is there
# WASMOUSE_VERSION     the version, or empty for the latest
# WASMOUSE_REPOSITORY  the address of the repository; empty means SERVER/ACTION_REPOSITORY
set -eu

mkdir -p "$TO"
if [ -z "$WASMOUSE_VERSION" ] && present=$(command -v wasmouse); then
    echo "using $present" >&2
    ln -sf "$present" "$TO/wasmouse"
    exit 0
fi
if [ -z "$WASMOUSE_REPOSITORY" ]; then
    WASMOUSE_REPOSITORY=$SERVER/$ACTION_REPOSITORY
fi
export WASMOUSE_REPOSITORY
installer=$(dirname "$0")/../../../install.sh
if [ -n "$WASMOUSE_VERSION" ]; then
    sh "$installer" --to "$TO" --version "$WASMOUSE_VERSION"
else
    sh "$installer" --to "$TO"
fi
