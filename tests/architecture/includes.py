#!/usr/bin/env python3
"""Folders of src/ include each other downward only, and no file has grown past what one can read at a sitting.

usage: includes.py PROJECT_FOLDER
"""
import pathlib
import re
import sys

# A folder may include itself, the folders listed here, and what those may include.
MAY_INCLUDE = {
    "base": [],
    "parallel": ["base"],
    "state": ["base", "parallel"],
    "keyword": ["base"],
    "model": ["base", "keyword"],
    "search": ["state"],
    "laws": ["parallel", "keyword", "model"],
    "surfaces": ["state"],
    "extension": ["state", "keyword", "model"],
    "loads": ["search", "state", "keyword", "model", "extension"],
    "sph": ["loads", "search", "state", "keyword", "model", "laws", "surfaces", "extension"],
    "rigid": ["loads", "search", "state", "keyword", "model", "surfaces", "extension"],
    "elements": ["loads", "search", "state", "keyword", "model", "laws", "extension", "surfaces"],
    "contact": ["loads", "search", "state", "keyword", "model", "surfaces", "extension"],
    "output": ["state"],
    "d3plot": ["elements", "rigid", "extension", "output"],
    "gauges": ["sph", "rigid", "extension", "output"],
    "waves": ["gauges", "sph", "rigid", "extension"],
    "time": ["state", "search", "output"],
    "vtk": ["state", "output"],
}
TOP = "app"  # may include everything; nothing includes it
THREADS = re.compile(r"#\s*(pragma\s+omp\s+(?!simd|declare\s+simd)|include\s*<(omp\.h|thread|mutex|future|condition_variable)>)")
ENDS = re.compile(r"(?<![\w:.>])(?:std::)?(?:exit|abort|_Exit|quick_exit|terminate)\s*\(")
PRINTS = re.compile(r"\bstd::(cout|cerr|clog)\b|(?<![\w:.])f?printf\s*\(|\bfmt::print\b")
CATCH_ALL = re.compile(r"catch\s*\(\s*\.\.\.\s*\)")
FIELD_BY_LITERAL = re.compile(r'\b(?:fields(?:\(\))?|set)\s*(?:\.|->)\s*find\(\s*"')
LONGEST = 500
# A type of namespace courant: clang-format puts it at the begin of its line.
TYPE = re.compile(r"^(?:class|struct|enum class|enum)\s+(?:alignas\([^)]*\)\s*)?(\w+)\b(?!::)[^;\n]*$", re.M)
NAMESPACE = re.compile(r"^namespace (\S+) \{", re.M)


def closure(folder):
    """Every folder that `folder` may include."""
    seen, waiting = {folder}, [folder]
    while waiting:
        for below in MAY_INCLUDE[waiting.pop()]:
            if below not in seen:
                seen.add(below)
                waiting.append(below)
    return seen


def faults_of_file(name, folder, text, folders):
    """Messages on one file; `folder` is the one under src/."""
    faults = []
    allowed = folders if folder == TOP else closure(folder)
    for number, line in enumerate(text.splitlines(), 1):
        where = f"{name}:{number}: "
        include = re.match(r'\s*#\s*include\s*"([^"]+)"', line)
        if include:
            target = include.group(1).split("/")[0] if "/" in include.group(1) else None
            if target is None or ".." in include.group(1):
                faults.append(where + f'"{include.group(1)}" should be written as "folder/file"')
            elif target not in folders:
                faults.append(where + f'"{include.group(1)}": there is no folder src/{target}')
            elif target not in allowed:
                faults.append(where + f"{folder} may not include {target}")
        code = re.sub(r'"(\\.|[^"\\])*"', '""', line.split("//")[0])
        if folder != "parallel" and THREADS.search(line):
            faults.append(where + "threads are the business of parallel/")
        if folder != TOP and ENDS.search(code):
            faults.append(where + "the library never ends the program")
        if folder != TOP and PRINTS.search(code):
            faults.append(where + "the library never prints")
        if folder != TOP and CATCH_ALL.search(code):
            faults.append(where + "catch (...) hides faults")
        if FIELD_BY_LITERAL.search(line.split("//")[0]):
            faults.append(where + "a field of another folder by a literal name; it belongs in state/shared_fields.hpp")
    lines = text.count("\n")
    if lines > LONGEST:
        faults.append(f"{name}: {lines} lines; split it below {LONGEST}")
    return faults


def faults_of_types(headers):
    """Two types of one name, in headers that nobody includes together, are one to the linker. `headers`: name -> text."""
    seen, faults = {}, []
    for name, text in headers.items():
        inside = NAMESPACE.search(text)
        for found in TYPE.finditer(text):
            other = seen.setdefault((inside.group(1) if inside else "", found.group(1)), name)
            if other != name:
                faults.append(f"{name}: {found.group(1)} is a type of {other}, too")
    return faults


def check(project):
    """All messages on a project."""
    source = project / "src"
    folders = {p.name for p in source.iterdir() if p.is_dir() and p.name != "python"}
    faults = [f"src/{r}: a new folder needs a line in tests/architecture/includes.py" for r in sorted(folders - set(MAY_INCLUDE) - {TOP})]
    files, headers = 0, {}
    for path in sorted(source.rglob("*")):
        if path.suffix not in (".hpp", ".cpp", ".h"):
            continue
        folder = path.relative_to(source).parts[0]
        if folder in MAY_INCLUDE or folder == TOP:
            files += 1
            text = path.read_text(encoding="utf-8")
            faults += faults_of_file(str(path.relative_to(project)), folder, text, folders)
            if path.suffix != ".cpp":
                headers[str(path.relative_to(project))] = text
    faults += faults_of_types(headers)
    if files == 0:
        faults.append("src/ holds no source file")
    return faults


def self_test():
    """The rules must see what they forbid."""
    folders = set(MAY_INCLUDE) | {TOP}
    bad = {
        ("laws", '#include "state/world.hpp"\n'): "laws may not include state",
        ("base", '#include "state/field.hpp"\n'): "base may not include state",
        ("sph", '#include "contact/contact.hpp"\n'): "sph may not include contact",
        ("sph", '#include "nowhere/x.hpp"\n'): "there is no folder",
        ("sph", '#include "../state/field.hpp"\n'): "should be written",
        ("sph", "#pragma omp parallel for\n"): "threads",
        ("sph", "#include <thread>\n"): "threads",
        ("model", "  std::exit(1);\n"): "never ends",
        ("model", '  std::cout << "x";\n'): "never prints",
        ("model", "} catch (...) {\n"): "hides",
        ("contact", 'p.fields.find("near_wall")\n'): "literal name",
        ("loads", 'points.set->find("fixed")\n'): "literal name",
        ("model", "\n" * (LONGEST + 1)): "split",
    }
    good = [
        ("contact", "shared_fields::near_wall.find(p.fields); p.fields.find(name)\n"),
        ("sph", '#include "parallel/parallel.hpp"\n#pragma omp simd\n'),
        ("app", '#include "contact/contact.hpp"\nstd::cout << 1;\n'),
        ("model", "// exit(1) in a comment\nstd::snprintf(b, 8, \"printf(\");\n"),
    ]
    for (folder, text), message in bad.items():
        if not any(message in f for f in faults_of_file("x", folder, text, folders)):
            return [f"self test: {folder}: {text.strip()[:60]!r} was not seen"]
    twice = {"a.hpp": "class A {\n};\nclass B;\n", "b.hpp": "struct A : C {\n};\nclass B {\n};\n"}
    if len(faults_of_types(twice)) != 1 or faults_of_types({"a.hpp": "class B;\n", "b.hpp": "enum class B {\n"}):
        return ["self test: types of one name"]
    for folder, text in good:
        if faults_of_file("x", folder, text, folders):
            return [f"self test: {faults_of_file('x', folder, text, folders)[0]}"]
    return []


if __name__ == "__main__":
    messages = self_test() + check(pathlib.Path(sys.argv[1]))
    print("\n".join(messages) or "folders are in order")
    sys.exit(1 if messages else 0)
