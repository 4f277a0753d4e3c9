#!/bin/sh
# Gradescope runs this once, as root, when the image of the autograder is built.
#
# It installs wasmouse: the program `wasmouse` that is in the autograder's zip file, or what the
# zip file's install.sh downloads. WASMOUSE_AUTOGRADER is the folder that Gradescope calls
# /autograder.
set -eu

root=${WASMOUSE_AUTOGRADER:-/autograder}
source=$root/source
mkdir -p "$root/bin"
if [ -f "$source/wasmouse" ]; then
    cp "$source/wasmouse" "$root/bin/wasmouse"
    chmod 755 "$root/bin/wasmouse"
else
    if ! command -v curl >/dev/null 2>&1; then
        apt-get update
        apt-get install -y --no-install-recommends ca-certificates curl
    fi
    sh "$source/install.sh" --to "$root/bin"
fi
"$root/bin/wasmouse" --version
