#!/usr/bin/env bash
# What the tools say of themselves and of mistakes: help of 80 columns, manuals and completions of the same options, old names, slips of the pen, files
# that hold no tree, notes that say what to do.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
treesim() { command treesim "$@"; } # as users call it

# The options of --help are among those of --help-all, and these those of the manual and of each shell.
pages=(treegen treeconvert treesim "treesim join" treeprofile "treeprofile error" "treeprofile stability" "treeprofile modes"
    "treeprofile scaling" "treeprofile compare")
for page in "${pages[@]}"; do
    # shellcheck disable=SC2086
    expect 0 $page --help
    cp out short
    # shellcheck disable=SC2086
    expect 0 $page --help-all
    cp out all
    ! grep -nE '^.{81}' short all || fail "$page: help is wider than 80 columns"
    [[ $(wc -l <short) -le $(wc -l <all) ]] || fail "$page: --help is longer than --help-all"
    grep -oE '^  (-[a-zA-Z], )?-?-[a-z-]+' all | grep -oE -- '--[a-z-]+' | sort -u >options
    [[ $(wc -l <options) -ge 5 ]] || fail "$page has $(wc -l <options) options"
    [[ -z $(comm -13 options <(grep -oE '^  (-[a-zA-Z], )?--[a-z-]+' short | grep -oE -- '--[a-z-]+' | sort)) ]] || fail "$page: --help knows more"
    # shellcheck disable=SC2086
    $page --help-as man >man
    sed -n 's/^\\fB//p' man | sed 's/\\fR.*//; s/\\-/-/g' | grep -oE -- '--[a-z-]+' | sort -u | cmp -s - options ||
        fail "$page: the manual has other options than the help: $(sed -n 's/^\\fB//p' man)"
    if command -v groff >/dev/null; then
        groff -man -Tutf8 -ww man >shown 2>err && [[ ! -s err ]] || fail "$page: groff does not like the manual: $(cat err)"
    fi
    words=$page
    [[ $page == *" "* ]] || words="$page "
    for shell in bash zsh fish; do
        "${page%% *}" --help-as "$shell" >"$shell.of"
        grep -oE -- '--[a-z-]+|-l [a-z-]+' "$shell.of" | sed 's/^-l /--/' | sort -u >known
        [[ -z $(comm -23 options known) ]] || fail "$shell completes no $(comm -23 options known) of $page"
        ! command -v $shell >/dev/null || $shell -n "$shell.of" || fail "$shell does not like $page's completions"
    done
done
offered() { # TOOL WORD...: what bash offers for the last word
    COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
    COMPREPLY=()
    "_$1" "$1" "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD - 1]}" || true
    echo "${COMPREPLY[*]}"
}
for tool in treesim treeprofile; do source <("$tool" --help-as bash); done
[[ $(offered treesim --wi) == "--wind" ]] || fail "treesim --wi is completed to $(offered treesim --wi)"
[[ $(offered treesim tree.json --wind g) == "gusty" ]] || fail "--wind g is completed to $(offered treesim tree.json --wind g)"
[[ $(offered treeprofile mo) == "modes" ]] || fail "treeprofile mo is completed to $(offered treeprofile mo)"
[[ $(offered treeprofile compare --f) == "--fail-above --format" || $(offered treeprofile compare --f) == "--fail-above" ]] ||
    fail "treeprofile compare --f is completed to $(offered treeprofile compare --f)"

if command -v fish >/dev/null; then
    treeprofile --help-as fish >treeprofile.fish
    [[ $(fish -c 'source treeprofile.fish; complete -C "treeprofile compare --fa"' | cut -f 1) == --fail-above ]] || fail "fish completes no --fail-above"
    [[ -z $(fish -c 'source treeprofile.fish; complete -C "treeprofile modes --fail-a"') ]] || fail "fish offers --fail-above to treeprofile modes"
    [[ $(fish -c 'source treeprofile.fish; complete -C "treeprofile --wind gu"' | cut -f 1) == gusty ]] || fail "fish completes no wind"
fi

treegen --age 12 --bodies 60 --leaves -q | treeconvert - -q -o tree.json

# An empty value, as of a shell's variable that was never set, is none.
for page in treegen "treeconvert tree.json" "treesim tree.json" "treeprofile tree.json"; do
    tool=${page%% *} count=0
    while read -r name; do
        count=$((count + 1))
        # shellcheck disable=SC2086
        refused 1 ": is " $page "$name" ''
        grep -qE "(is empty|is ''), expected [^ ]|is '', expected" err || fail "$page $name '': $(cat err)"
        # shellcheck disable=SC2086
        refused 1 "$name: is empty after its '='" $page "$name="
    done < <("$tool" --help-all | sed -nE 's/^  (-[a-zA-Z], )?(--[a-z-]+) [^ ].*/\2/p')
    [[ $count -ge 8 ]] || fail "$tool has $count options with a value"
done
refused 1 "INPUT: is empty, expected a file name" treesim ''
refused 1 "PART: is empty, expected a file name" treesim join '' -o joined.json

# Old names say the new ones.
for old in "--hash:--report hash" "--explain:--report plan" "--report-error:--report error" "--report-cost:--report cost" \
    "--report-rigid:--report rigid" "--pose drawn:--set pose=" "--joint-limit=3:--set joint_limit=" "--stiffness-scale 2:--set stiffness_scale=" \
    "--damping-scale 2:--set damping_scale=" "--joint-inertia paper:--set joint_inertia=" "--join part.json:treesim join"; do
    # shellcheck disable=SC2086
    refused 1 "is now ${old#*:}" treesim tree.json ${old%%:*}
done
refused 1 "is now --set pose=" treeprofile tree.json --pose rest
refused 1 "expected cost, error, guards, hash, plan, rigid" treesim tree.json --report hsah

# Slips of the pen.
refused 1 "did you mean --wind?" treesim tree.json --wnd gusty
refused 1 "did you mean compare?" treeprofile comapre a.json b.json
refused 1 "did you mean join?" treesim jion a.json b.json
echo '{"format": "bough-scene", "version": 1, "wind": {"velocty": [1, 0, 0]}}' >slip.json
refused 2 '/wind/velocty: is an unknown field, did you mean "velocity"?' treesim slip.json
echo '{"format": "bough-wind", "version": 1, "velocty": [1, 0, 0]}' >wind.json
refused 2 '/velocty: is an unknown field, did you mean "velocity"?' treesim tree.json --wind wind.json

# Files that hold no tree are named, with what to do.
echo '<Tree/>' >tree.xml
gzip -k tree.xml
printf '\xff\xfe<\0T\0/\0>\0' >wide.xml
printf 'PK\3\4 and so on' >tree.zip
printf 'newmtl bark\nKd 1 1 1\n' >tree.mtl
printf 'BLENDER-v304' >tree.blend
for tool in treesim treeconvert "treegen --import"; do
    while IFS=: read -r file is; do
        # shellcheck disable=SC2086
        refused 2 "$is" $tool "$file"
    done <<'END'
tree.xml:is XML, but neither SpeedTree raw XML
tree.xml:export it from SpeedTree as Raw XML
tree.xml.gz:compressed by gzip; unpack it first
wide.xml:UTF-16 text; save it as UTF-8
tree.zip:archive; unpack it first
tree.mtl:name the .obj
tree.blend:a Blender scene; export
END
done

# A run in which nothing acts says so; a guess is told once.
expect 0 treesim tree.json --frames 3 --no-output
grep -q 'nothing will move: .*--wind' err || fail "a run without any force does not say so: $(cat err)"
for what in "--wind breeze" "--set pose=rest" "--resume state.json" \
    '--set attachments=[{"on":{"body":0},"target":[1,2,0],"stiffness":5}]'; do
    [[ $what != --resume* ]] || expect 0 treesim tree.json --frames 3 --no-output --wind breeze --save-state state.json
    # shellcheck disable=SC2086
    treesim tree.json --frames 3 --no-output $what ${state:-} 2>err || [[ $what == --resume* ]] || fail "$what fails: $(cat err)"
    ! grep -q 'nothing will move' err || fail "$what moves, and yet: $(cat err)"
done
for tool in "treeconvert $maple" "treegen --import $maple"; do
    # shellcheck disable=SC2086
    expect 0 $tool --stats -o out.json
    [[ $(grep -c 'up axis: the file states none' err) -eq 1 ]] || fail "$tool --stats tells a guess $(grep -c 'up axis: the file states none' err) times"
done
expect 0 treesim tree.json --wind storm --frames 20 --no-output --report guards
grep -q '^guards fast_turns [0-9]' err || fail "--report guards counts nothing: $(cat err)"
