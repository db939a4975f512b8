# lint.tidy BUILD_FOLDER: clang-tidy is silent on every .cpp of ours.
#
# A file that was clean is looked at again only when it, a header of ours that it includes, its
# compile command, .clang-tidy or clang-tidy itself has changed: BUILD_FOLDER/lint holds a stamp
# named by the hash of all these.
#
# Most of the time goes into what the files include. So several are checked as one source that
# includes them, an eighth of the work; where that finds anything, each of them is checked alone,
# and only that counts.
import concurrent.futures
import hashlib
import json
import os
import re
import shlex
import subprocess
import sys

import sources

INCLUDE = re.compile(rb'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)
FILES_AT_ONCE = 8


def read(path):
    with open(path, "rb") as file:
        return file.read()


def with_headers(path, seen):
    """Adds to `seen` the file and all of ours that it includes, however far down."""
    if path in seen or not os.path.isfile(path):
        return
    seen.add(path)
    for name in INCLUDE.findall(read(path)):
        for folder in (".", "shaders", os.path.dirname(path)):
            with_headers(os.path.normpath(os.path.join(folder, name.decode())), seen)


def flags_of(entry):
    """The compile command's flags, without compiler, input and output."""
    words = shlex.split(entry["command"])
    first = next(i for i, word in enumerate(words) if word.startswith("-"))
    flags = []
    skipped = False
    for word in words[first:]:
        if skipped or word in ("-c", entry["file"]):
            skipped = False
        elif word == "-o":
            skipped = True
        else:
            flags.append(word)
    return tuple(flags)


def flags_of_files(build_folder):
    """{path: flags} of every file that a target compiles, alone or within a unity source."""
    flags = {}
    for entry in json.loads(read(os.path.join(build_folder, "compile_commands.json"))):
        names = [entry["file"]]
        if re.fullmatch(r"unity_\d+_cxx\.cxx", os.path.basename(entry["file"])):
            names = [name.decode() for name in INCLUDE.findall(read(entry["file"]))]
        for name in names:
            flags[os.path.relpath(name)] = flags_of(entry)
    return flags


def fingerprint(path, flags, common):
    seen = set()
    with_headers(path, seen)
    digest = hashlib.sha256(common + " ".join(flags).encode())
    for name in sorted(seen):
        digest.update(name.encode() + b"\0" + read(name) + b"\0")
    return digest.hexdigest()


def tidy(path, flags):
    return subprocess.run(["clang-tidy", "--quiet", path, "--", *flags],
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def check(batch):
    """[(path, what was found or "")] of {stamps: folder, number, flags, paths}."""
    together = os.path.join(batch["stamps"], f"together_{batch['number']}.cxx")
    with open(together, "w") as file:
        for path in batch["paths"]:
            file.write(f'#include "{os.path.abspath(path)}"  // NOLINT(bugprone-suspicious-include)\n')
    if tidy(together, batch["flags"]).returncode == 0:
        return [(path, "") for path in batch["paths"]]
    found = []
    for path in batch["paths"]:
        result = tidy(path, batch["flags"])
        found.append((path, result.stdout + result.stderr if result.returncode else ""))
    return found


def batches_of(due, flags, stamps):
    """The files of a folder that share their flags go together."""
    groups = {}
    for path in due:
        groups.setdefault((os.path.dirname(path), flags[path]), []).append(path)
    parts = [(key[1], group[i:i + FILES_AT_ONCE])
             for key, group in groups.items() for i in range(0, len(group), FILES_AT_ONCE)]
    return [{"stamps": stamps, "number": i, "flags": part[0], "paths": part[1]}
            for i, part in enumerate(parts)]


def main():
    build_folder = sys.argv[1]
    stamps = os.path.join(build_folder, "lint")
    os.makedirs(stamps, exist_ok=True)
    flags = flags_of_files(build_folder)
    common = read(".clang-tidy") + subprocess.check_output(["clang-tidy", "--version"])
    files = sources.files_under(["server", "protocol", "client", "lab"], [".cpp"])
    assert files, "not run from the root of the source tree"

    failures = 0
    due = {}
    for path in files:
        if path not in flags:
            print(f"{path}:1: no target compiles this file")
            failures += 1
            continue
        stamp = os.path.join(stamps, fingerprint(path, flags[path], common))
        if not os.path.exists(stamp):
            due[path] = stamp
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for found in pool.map(check, batches_of(due, flags, stamps)):
            for path, output in found:
                if output:
                    print(output)
                    failures += 1
                else:
                    open(due[path], "w").close()
    print(f"{len(files)} files, {len(due)} checked now, {failures} with findings")
    return 1 if failures else 0


sys.exit(main())
