# The local Python environment of the tests, for scripts in bash that stand at the root of the project:
#
#     source tests/environment.sh
#
# makes or updates it, puts the path of its interpreter into `python`, and tells cargo where the libclang
# in it is, which the Rust tests that use the `fmi` crate need.

environment="${CARGO_TARGET_DIR:-target}/venv"
python="$environment/bin/python"
requirements=(tests/python/requirements.txt)
if [[ -n "${UAM_FULL-}" ]]; then requirements+=(tests/python/requirements-full.txt); fi

fail() {
    printf 'error: %s\n' "$@" >&2
    exit 1
}

make_environment() {
    local base="${PYTHON:-python3}"
    command -v "$base" >/dev/null || fail "there is no Python interpreter \`$base\`" \
        "install Python 3.11 or newer, or name one: PYTHON=/usr/bin/python3.12 bash tests/run"
    "$base" -c 'import sys; sys.exit(sys.version_info < (3, 11))' ||
        fail "$("$base" --version) is too old: Python 3.11 or newer is needed; PYTHON=... names another interpreter"

    # What was asked for when the environment was made: if it is the same now, nothing is to be done.
    local wanted
    wanted="$("$base" -c 'import sys; print(sys.version, sys.base_prefix)') $(cat "${requirements[@]}" | cksum)"
    [[ -x "$python" && "$(cat "$environment/made-for" 2>/dev/null)" == "$wanted" ]] && return

    echo "Making the Python environment $environment ..."
    rm -rf "$environment"
    mkdir -p "$(dirname "$environment")"
    "$base" -m venv "$environment" || {
        rm -rf "$environment"
        fail "$base cannot make virtual environments (Debian: apt-get install python3-venv)" \
            "PYTHON=... names another interpreter"
    }
    "$python" -m pip install --quiet --disable-pip-version-check "${requirements[@]/#/--requirement=}" ||
        fail "the packages in ${requirements[*]} cannot be installed; see above"
    printf '%s\n' "$wanted" >"$environment/made-for"
}

make_environment

# The linkers for other platforms, which only the large set has.
if [[ -n "${UAM_FULL-}" ]]; then PATH="$(cd "$environment/bin" && pwd):$PATH"; fi

LIBCLANG_PATH="$("$python" -c 'import pathlib, clang; print(pathlib.Path(clang.__path__[0], "native"))')"
export LIBCLANG_PATH
# libclang from PyPI comes without its own headers; those of the C compiler serve as well.
BINDGEN_EXTRA_CLANG_ARGS="-I$("${CC:-cc}" -print-file-name=include)"
export BINDGEN_EXTRA_CLANG_ARGS
