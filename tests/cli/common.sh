# common.sh: sourced by each script here. Arguments of a script: the folder of the tools, the project's folder, the
# build folder. Each works in its own temporary folder, says what it finds wrong, and exits 0, 1 or 77 (skipped).
set -euo pipefail
export LC_ALL=C
bin=$(cd "$1" && pwd)
top=$(cd "$2" && pwd)
build=$(cd "${3:-$1/..}" && pwd)
export PATH=$bin:/usr/bin:/bin:$PATH # the programs that tests/run installs, before others of their names
work=$(mktemp -d)
cleanup() { rm -rf "$work"; }
trap cleanup EXIT
cd "$work"
maple=$top/data/young_maple.xml
ending=json # of a tool's output: what wrong_use and bad_input write to
sanitizers=$(sed -n 's/BOUGH_SANITIZE:STRING=//p' "$build/CMakeCache.txt") # empty in a plain build
: "$build" "$ending" "$maple" "$sanitizers"

# Runs start at rest here, as they are held against closed forms and each other, unless they say how they start. settle.sh has the default.
treesim() {
    case " $* " in
    "  " | " join "* | *" --settle "* | *" --help "* | *" --version "*) command treesim "$@" ;;
    *) command treesim --settle 0 "$@" ;;
    esac
}

fail() {
    echo "FAILED: $*" >&2
    exit 1
}

# expect CODE COMMAND...: runs it with stdout in $work/out and stderr in $work/err, and checks the exit code.
expect() {
    local wanted=$1 code=0
    shift
    "$@" >out 2>err </dev/null || code=$?
    [[ $code -eq $wanted ]] || fail "exit $code, expected $wanted: $* ($(head -c 300 err))"
}

# refused CODE TEXT COMMAND...: fails with this code and exactly one line on stderr that holds TEXT and the tool's name.
refused() {
    local wanted=$1 text=$2
    shift 2
    expect "$wanted" "$@"
    one_line "$text" "$@"
}

one_line() {
    local text=$1
    shift
    local lines=()
    mapfile lines <err
    [[ ${#lines[@]} -eq 1 && ${lines[0]} == *$'\n' ]] || fail "${#lines[@]} lines on stderr, expected one, whole: $*: $(cat err)"
    [[ ${lines[0]} == *"$text"* ]] || fail "'$text' is not in the message of $*: $(cat err)"
    [[ ${lines[0]} == *"$1: "* ]] || fail "the message of $* does not begin with its name: $(cat err)"
}

# absent FILE...: none of them, and no unfinished output, is there.
absent() {
    local file
    for file in "$@"; do [[ ! -e $file ]] || fail "$file was left behind"; done
    [[ -z $(find . -name '.bough-*' -print -quit) ]] || fail "an unfinished file was left behind: $(find . -name '.bough-*')"
}

# hash ARGUMENT...: the line that tells the hash where treesim ends.
hash() { treesim "$@" --report hash 2>&1 >/dev/null | grep '^hash [0-9a-f]\{16\}$'; }

# code LANGUAGE PAGE: the block of that language in one of the project's pages.
code() {
    awk -v fence="\`\`\`$1" '$0 == fence { on = 1; next } /^```/ { on = 0 } on' "$top/$2" | grep . || fail "no $1 in $2"
}

same() {
    cmp -s "$1" "$2" || fail "$1 and $2 differ"
}

# wrong_use TOOL INPUT: what every tool must refuse, given an input (a file) that it takes. Further arguments go along.
wrong_use() {
    local tool=$1 input=$2
    shift 2
    refused 1 "--help" "$tool"
    refused 1 "--no-such-option" "$tool" "$input" --no-such-option "$@"
    refused 1 "-o" "$tool" "$input" "$@" -o
    refused 1 "--threads" "$tool" "$input" --threads 0 "$@"
    refused 1 "--threads" "$tool" "$input" --threads two "$@"
    refused 1 "-o" "$tool" "$input" "$@" -o --threads 2
    expect 0 "$tool" --help
    [[ -s out && ! -s err ]] || fail "$tool --help belongs on stdout"
    expect 0 "$tool" --version
    grep -q "^$tool [0-9]" out && grep -q '^compiler ' out && grep -q '^flags ' out && grep -q '^simd ' out ||
        fail "$tool --version: $(cat out)"
    refused 4 "No such file" "$tool" "$input" "$@" -o missing/folder/x.$ending
    mkdir -p folder
    refused 4 "irectory" "$tool" "$input" "$@" -o folder
    closed_stdout "$tool" "$input" "$@"
    full_disk "$tool" "$input" "$@"
}

# bad_input TOOL OPTION... : the input, last, is missing, empty, half a document, a directory, not a document.
bad_input() {
    local whole=$1 file
    shift
    refused 2 "missing.json" "$@" missing.json -o made.$ending
    mkdir -p folder
    refused 2 "folder" "$@" folder -o made.$ending
    : >empty.json
    head -c $(($(wc -c <"$whole") / 2)) "$whole" >half.json
    echo "once upon a time" >prose.json
    head -c 4000 /dev/urandom >noise.json
    for file in empty half prose noise; do
        refused 2 "$file.json" "$@" $file.json -o made.$ending
        absent made.$ending
    done
    refused 2 "<stdin>" "$@" - -o made.$ending
    absent made.$ending
}

closed_stdout() {
    local code=0
    "$@" >&- 2>err </dev/null || code=$?
    [[ $code -eq 4 ]] || fail "exit $code with stdout closed, expected 4: $*"
    one_line "stdout" "$@"
    # A reader that has gone: enough output to fill the pipe is not needed, closing it is.
    code=0
    { sleep 0.1; "$@" 2>err </dev/null || echo $? >code; } | true
    [[ $(cat code) -eq 4 ]] || fail "exit $(cat code) with the reader gone, expected 4: $*"
    one_line "stdout" "$@"
    rm -f code
}

full_disk() {
    if [[ -w /dev/full ]]; then
        local code=0
        "$@" >/dev/full 2>err </dev/null || code=$?
        [[ $code -eq 4 ]] || fail "exit $code on a full disk, expected 4: $*"
        one_line "space" "$@"
    fi
    mkdir -p small
    if ! mount -t tmpfs -o size=4k tmpfs small 2>/dev/null; then
        echo "notice: no tmpfs can be mounted here, the full disk is /dev/full alone"
        return
    fi
    head -c 8192 /dev/zero >small/fill 2>/dev/null || true # a short output would fit otherwise
    local code=0
    "$@" -o small/full.$ending >out 2>err </dev/null || code=$?
    local left
    left=$(ls -A small | grep -vx fill || true)
    umount small
    [[ $code -eq 4 ]] || fail "exit $code on a full tmpfs, expected 4: $*"
    [[ -z $left ]] || fail "left on the full tmpfs: $left"
    one_line "space" "$@"
}

# A Python that has numpy, the system's where another stands before it; empty: none.
python_with_numpy() {
    local python
    for python in python3 /usr/bin/python3; do
        if "$python" -c 'import numpy' 2>/dev/null; then
            echo "$python"
            return
        fi
    done
}
