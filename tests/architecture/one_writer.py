#!/usr/bin/env python3
"""What the programs write is opened in one location for each language, src/output/file.cpp and src/python/courant/files.py: there links, devices, pipes
and inputs are looked at. No other file opens anything for writing, renames or copies. HDF5 writes to memory alone.

usage: one_writer.py PROJECT_FOLDER
"""
import pathlib
import re
import sys

# Language -> (ending, the one location, folders left out, what opens for writing elsewhere).
CPP = re.compile(r"\b(?:w?ofstream|basic_ofstream|filebuf|fopen|freopen|fdopen|tmpfile|mkstemp|mkostemp|creat|openat|link|symlink|truncate|mkfifo|"
                 r"resize_file|copy_file)\s*[({<]|\bofstream\b|\bfstream\s+\w+\s*[({]|(?:::|\bstd::)rename\s*\(|\bfs::(?:rename|copy)\w*\s*\(|(?<![\w.>:])::open\s*\(")
PYTHON = re.compile(r"\.write_(?:text|bytes)\(|\bsavefig\((?!frame,|content,|file, format=\"svg\")|\bos\.(?:open|rename|replace|link|symlink|truncate|mkfifo)\(|"
                    r"\bshutil\.(?:copy\w*|move)\(|\bsavetxt\(|\bnp\.save\w*\(|\.to_csv\(|(?<![\w.])open\((?!open_for_writing\()[^()]*(?:\([^()]*\)[^()]*)*,\s*(?:mode=)?[rbfu]*\"[^\"]*[wax+]|"
                    r"h5py\.File\((?![^\n]*(?:backing_store=False|open_file_image))[^\n]*\"[wax+r]*[wax+]|\.open\(\"[^\"]*[wax+]")
# An open file or a rename that is none of these: what, and why.
ALLOWED = {
    "src/app/run/restart.cpp": "fs::rename(one.file, to, error)",  # restart files of a run that is done once more go to restart_old
}
ALONE = {"src/output/file.cpp", "src/python/courant/files.py"}


def faults_of(name, text):
    rule, comment = (PYTHON, "#") if name.endswith(".py") else (CPP, "//")
    out = []
    for number, line in enumerate(text.splitlines(), 1):
        code = line.split(comment)[0]
        if rule.search(code) and ALLOWED.get(name, "\0") not in line:
            out.append(f"{name}:{number}: opens, renames or copies a file by itself: {line.strip()}")
    if "H5Fcreate" in text and "H5Pset_fapl_core(access_, growth, false)" not in text:
        out.append(f"{name}: HDF5 writes to a file")
    return out


def check(project):
    faults, files = [], 0
    for path in sorted((project / "src").rglob("*")):
        name = str(path.relative_to(project))
        if path.suffix in (".cpp", ".hpp", ".h", ".py") and name not in ALONE:
            files += 1
            faults += faults_of(name, path.read_text(encoding="utf-8"))
    return faults if files > 100 else faults + ["src/ holds no source files"]


def self_test():
    bad = {"a.cpp": ["std::ofstream file(name);", "auto f = std::fopen(n, \"w\");", "int d = ::open(n, O_WRONLY);", "std::filesystem::copy_file(a, b);",
                     "fs::rename(a, b);", "std::rename(a, b);", "std::fstream both(name);", "std::filesystem::resize_file(a, 3);", "H5Fcreate(name, 0, 0, 0);"],
           "a.py": ['open(path, "wb")', 'open(f(x), mode="a")', "path.write_text(x)", "figure.savefig(path)", "os.replace(a, b)", 'h5py.File(name, "w")',
                    'path.open("w")', "shutil.move(a, b)", "os.open(a, os.O_WRONLY)", "np.savetxt(a, b)"]}
    good = {"a.cpp": ["std::ifstream file(name);", "bool SensorGate::open() const {", "// std::ofstream", "if (!FrozenPairs::open(h)) return;"],
            "a.py": ['open(path, "rb")', "open(path)", "text.replace(a, b)", 'with open(open_for_writing(path), "wb") as log:', 'HistoryFile.open(a / "history.h5", b)',
                     'h5py.File(h5py.h5f.open_file_image(data))', 'h5py.File(x, "w", driver="core", backing_store=False)']}
    out = [f"self test: not seen: {line}" for name, lines in bad.items() for line in lines if not faults_of(name, line)]
    return out + [f"self test: {line} is fine" for name, lines in good.items() for line in lines if faults_of(name, line)]


if __name__ == "__main__":
    messages = self_test() + check(pathlib.Path(sys.argv[1]))
    print("\n".join(messages) or "files are opened for writing in one place")
    sys.exit(1 if messages else 0)
