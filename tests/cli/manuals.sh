#!/usr/bin/env bash
# What the README files say can be done: each block marked sh runs as it stands, page by page, in a folder that looks like the project's.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

pages=$(cd "$top" && find README.md tools lib formats tests data -name README.md | sort)
draws=yes
for program in f3d Xvfb mogrify; do command -v "$program" >/dev/null || draws=no; done
[[ $draws == yes ]] || echo "notice: nothing draws here, lines with picture are left out"
tried=0
for page in $pages; do
    awk '/^```sh$/ { on = 1; next } /^```/ { on = 0 } on' "$top/$page" >commands
    [[ $draws == yes ]] || sed -i '/^picture /d' commands
    sed -i 's/^\(picture .*--fps\) [0-9]*/\1 1/' commands # a second of a moving picture is drawn once: without a graphics card that takes 2 s
    [[ -s commands ]] || continue
    rm -rf project
    mkdir -p project/build
    ln -s "$bin" project/build/tools
    for folder in data formats lib tests tools; do ln -s "$top/$folder" "project/$folder"; done
    (cd project && PATH=$top/tools:$PATH bash -euo pipefail ../commands >../said 2>../err </dev/null) ||
        fail "$page: a command fails: $(tail -n 3 err); of $(cat commands)"
    tried=$((tried + $(grep -c . commands)))
done
[[ $tried -gt 30 ]] || fail "only $tried lines of commands were found"
numpy=$(python_with_numpy)
if [[ -n $numpy ]]; then
    code python formats/documents/README.md >read.py
    treeconvert "$maple" -q -o maple.safetensors
    [[ $("$numpy" read.py maple.safetensors) =~ \ [0-9.]+\ kg$ ]] || fail "numpy reads no tree by formats/documents/README.md"
fi
if command -v python3 >/dev/null; then
    # shellcheck disable=SC2086
    (cd "$top" && tests/prose $pages) >said || fail "the pages: $(cat said)"
fi
