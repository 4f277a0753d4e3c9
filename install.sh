#!/bin/sh
# Downloads a prebuilt wasmouse, checks its SHA-256, and puts it into a folder of yours.
#
#     sh install.sh [--version VERSION] [--to FOLDER] [--target TRIPLE]
#
# It needs no root: the folder is ~/.local/bin unless --to names another one. It changes no
# configuration; when the folder is not on the PATH, it says so.
#
# WASMOUSE_REPOSITORY  the address of the repository that publishes the releases, for example
#                      https://HOST/OWNER/NAME. The installer of a release knows its own.
# WASMOUSE_DOWNLOAD    the address of the folder that has the archives; it replaces the one that
#                      is made of the repository and the version. It may begin with file://.
set -eu

# The release workflow puts the address of the repository here.
published_at=''

usage() {
    echo 'usage: sh install.sh [--version VERSION] [--to FOLDER] [--target TRIPLE]'
}

# fail MESSAGE [HINT]
fail() {
    printf 'error: %s\n' "$1" >&2
    if [ $# -gt 1 ]; then
        printf '\nhint: %s\n' "$2" >&2
    fi
    exit 1
}

has() {
    command -v "$1" >/dev/null 2>&1
}

# The platform of this machine, as Rust names it.
this_target() {
    processor=$(uname -m)
    case $processor in
        x86_64 | amd64) processor=x86_64 ;;
        aarch64 | arm64) processor=aarch64 ;;
        *) fail "there is no prebuilt wasmouse for the processor $processor" \
            'build it: cargo install --path host' ;;
    esac
    case $(uname -s) in
        Linux)
            # A C library of GNU says so; the others get the program that needs none.
            if (ldd --version 2>&1 || true) | grep -qi -e 'glibc' -e 'GNU libc'; then
                echo "$processor-unknown-linux-gnu"
            else
                echo "$processor-unknown-linux-musl"
            fi
            ;;
        Darwin) echo "$processor-apple-darwin" ;;
        *) fail "there is no prebuilt wasmouse for the system $(uname -s)" \
            'on Windows, use install.ps1' ;;
    esac
}

# download ADDRESS FILE
download() {
    case $1 in
        file://*)
            cp -- "${1#file://}" "$2" 2>/dev/null || return 1
            return
            ;;
    esac
    if has curl; then
        case $1 in
            https://*) curl --proto '=https' --tlsv1.2 --fail --silent --show-error --location \
                --retry 3 --output "$2" "$1" ;;
            *) curl --fail --silent --show-error --location --output "$2" "$1" ;;
        esac
    elif has wget; then
        wget --quiet --output-document="$2" "$1"
    else
        fail 'neither curl nor wget is installed'
    fi
}

# The SHA-256 of a file, in hexadecimal.
sha256() {
    if has sha256sum; then
        sha256sum "$1" | cut -d ' ' -f 1
    elif has shasum; then
        shasum -a 256 "$1" | cut -d ' ' -f 1
    elif has openssl; then
        openssl dgst -sha256 -r "$1" | cut -d ' ' -f 1
    else
        fail 'none of sha256sum, shasum and openssl is installed, so the download cannot be checked'
    fi
}

main() {
    version=''
    target=''
    folder=''
    while [ $# -gt 0 ]; do
        case $1 in
            -h | --help)
                usage
                exit 0
                ;;
            --version | --to | --target)
                [ $# -ge 2 ] || fail "$1 needs a value"
                case $1 in
                    --version) version=${2#v} ;;
                    --to) folder=$2 ;;
                    --target) target=$2 ;;
                esac
                shift 2
                ;;
            *)
                usage >&2
                fail "unknown argument: $1"
                ;;
        esac
    done
    if [ -z "$folder" ]; then
        [ -n "${HOME:-}" ] || fail 'HOME is not set' 'name a folder with --to'
        folder=$HOME/.local/bin
    fi
    [ -n "$target" ] || target=$(this_target)
    case $target in
        *-windows-*) fail "this installer is not for $target" 'on Windows, use install.ps1' ;;
    esac

    from=${WASMOUSE_DOWNLOAD:-}
    if [ -z "$from" ]; then
        repository=${WASMOUSE_REPOSITORY:-$published_at}
        [ -n "$repository" ] || fail 'no repository to download from' \
            'set WASMOUSE_REPOSITORY to the address of the one that publishes wasmouse'
        if [ -n "$version" ]; then
            from=${repository%/}/releases/download/v$version
        else
            from=${repository%/}/releases/latest/download
        fi
    fi
    from=${from%/}

    name=wasmouse-$target
    archive=$name.tar.gz
    temporary=$(mktemp -d)
    trap 'rm -rf "$temporary"' EXIT
    trap 'exit 130' INT
    trap 'exit 143' TERM
    echo "downloading $from/$archive" >&2
    download "$from/$archive" "$temporary/$archive" ||
        fail "failed to download $from/$archive" \
            'is there a release with that version for that platform?'
    download "$from/$archive.sha256" "$temporary/$archive.sha256" ||
        fail "failed to download $from/$archive.sha256" \
            'without its checksum, an archive is not installed'

    expected=$(cut -d ' ' -f 1 <"$temporary/$archive.sha256")
    case $expected in
        *[!0-9a-f]* | '') fail "$archive.sha256 has no SHA-256 in it" ;;
    esac
    [ ${#expected} -eq 64 ] || fail "$archive.sha256 has no SHA-256 in it"
    actual=$(sha256 "$temporary/$archive")
    [ "$actual" = "$expected" ] ||
        fail "$archive has the SHA-256 $actual and should have $expected" \
            'the download is damaged or is not what was published; nothing was installed'

    tar -xzf "$temporary/$archive" -C "$temporary" || fail "failed to unpack $archive"
    program=$temporary/$name/wasmouse
    [ -f "$program" ] || fail "$archive has no $name/wasmouse in it"
    if [ "$target" = "$(this_target)" ]; then
        installed=$("$program" --version) ||
            fail 'the program does not run on this machine; nothing was installed' \
                'try another --target'
        if [ -n "$version" ] && [ "$installed" != "wasmouse $version" ]; then
            fail "the archive has $installed instead of wasmouse $version; nothing was installed"
        fi
    fi

    mkdir -p "$folder" || fail "failed to create $folder"
    # Into the same folder first, so that the program is replaced as a whole.
    cp "$program" "$folder/.wasmouse.new" || fail "failed to write to $folder" \
        'name a folder of yours with --to'
    chmod 755 "$folder/.wasmouse.new"
    mv -f "$folder/.wasmouse.new" "$folder/wasmouse" || fail "failed to write to $folder"
    echo "installed $folder/wasmouse" >&2
    case :${PATH:-}: in
        *":$folder:"*) ;;
        *) echo "note: $folder is not on the PATH" >&2 ;;
    esac
}

# Called at the end, so that half a script does nothing.
main "$@"
