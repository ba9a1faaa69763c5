"""csharp.py HEADER DECLARED CC: what Bough.cs declares (DECLARED: CSharp.cs's list) against bough_c.h: sizes, places of fields and values of enums as the C
compiler CC has them, functions by the kinds of their results and parameters. Says what differs; exit 1 where something does."""

import pathlib
import re
import subprocess
import sys
import tempfile

header, declared, compiler = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]).read_text().splitlines(), sys.argv[3]
lines = [line.split() for line in declared]
of = lambda kind: [line[1:] for line in lines if line[0] == kind]
wrong = []

# The compiler is asked for all that C# names.
asked = ['printf("results %zu %zu\\n", sizeof(bough_result), sizeof(bough_field));']
for name, *_ in of("struct"):
    if name not in ("vector", "rotation"):
        asked.append(f'printf("struct {name} %zu\\n", sizeof(bough_{name}));')
for name, field, _ in of("field"):
    if name not in ("vector", "rotation"):
        asked.append(f'printf("field {name} {field} %zu\\n", offsetof(bough_{name}, {field}));')
for name, _ in of("enum"):
    asked.append(f'printf("enum {name} %lld\\n", (long long){name});')
with tempfile.TemporaryDirectory() as folder:
    source, program = pathlib.Path(folder, "layout.c"), pathlib.Path(folder, "layout")
    source.write_text(f'#include "{header.resolve()}"\n#include <stdio.h>\nint main(void) {{\n' + "\n".join(asked) + "\nreturn 0;\n}\n")
    subprocess.run([compiler, "-std=c99", "-o", program, source], check=True)
    there = set(subprocess.run([program], check=True, capture_output=True, text=True).stdout.splitlines())
here = {line for line in declared if not line.startswith("function") and line.split()[1] not in ("vector", "rotation")} | {"results 4 4"}
wrong += [f"C# has '{line}', C does not" for line in sorted(here - there)] + [f"C has '{line}', C# does not" for line in sorted(there - here)]
for name, size in ("vector", 24), ("rotation", 32):  # double[3], double[4]
    if [name, str(size)] not in of("struct"):
        wrong.append(f"{name} is not {size} bytes")

# Functions: the header's own text.
text = re.sub(r"/\*.*?\*/", "", header.read_text(), flags=re.S)


def kind(declaration):
    words = declaration.replace("const", "").split()
    if "*" in declaration or "[" in declaration:
        return "pointer"
    return "int32_t" if words[0] in ("bough_result", "bough_field") else words[0]


c_functions = {}
for result, name, parameters in re.findall(r"^([\w ]+?\*?) ?(bough_\w+)\(([^)]*)\);", text, flags=re.M):
    c_functions[name] = [kind(result)] + [kind(one) for one in parameters.split(",") if one.strip() != "void"]
assert len(c_functions) > 40, "the header's functions are not found"
cs_functions = {}
for name, *kinds in of("function"):
    if cs_functions.setdefault(name, kinds) != kinds:
        wrong.append(f"{name} is declared in two ways")
for name in sorted(c_functions.keys() | cs_functions.keys()):
    if c_functions.get(name) != cs_functions.get(name):
        wrong.append(f"{name}: C has {c_functions.get(name)}, C# {cs_functions.get(name)}")
print(*wrong, sep="\n", end="\n" if wrong else "")
if not wrong:
    print(f"csharp: {len(c_functions)} functions, {len(of('struct'))} structs and {len(of('enum'))} values of enums are declared as in bough_c.h")
sys.exit(1 if wrong else 0)
