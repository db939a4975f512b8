# lint.tidy BUILD_FOLDER: clang-tidy is silent on every .cpp of ours.
#
# A file that was clean is looked at again only when it, a header of ours that it includes, its
# compile command, .clang-tidy or clang-tidy itself has changed: BUILD_FOLDER/lint holds a stamp
# named by the hash of all these.
import concurrent.futures
import hashlib
import json
import os
import re
import subprocess
import sys

import sources

INCLUDE = re.compile(rb'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)


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


def fingerprint(path, command, common):
    seen = set()
    with_headers(path, seen)
    digest = hashlib.sha256(common + command.encode())
    for name in sorted(seen):
        digest.update(name.encode() + b"\0" + read(name) + b"\0")
    return digest.hexdigest()


def check(path, build_folder):
    result = subprocess.run(["clang-tidy", "-p", build_folder, "--quiet", path],
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    return path, result.returncode, result.stdout + (result.stderr if result.returncode else "")


def main():
    build_folder = sys.argv[1]
    stamps = os.path.join(build_folder, "lint")
    os.makedirs(stamps, exist_ok=True)
    commands = {os.path.relpath(entry["file"]): entry["command"] for entry in
                json.loads(read(os.path.join(build_folder, "compile_commands.json")))}
    common = read(".clang-tidy") + subprocess.check_output(["clang-tidy", "--version"])
    files = sources.files_under(["server", "protocol", "client"], [".cpp"])
    assert files, "not run from the root of the source tree"

    failures = 0
    due = {}
    for path in files:
        if path not in commands:
            print(f"{path}:1: no target compiles this file")
            failures += 1
            continue
        stamp = os.path.join(stamps, fingerprint(path, commands[path], common))
        if not os.path.exists(stamp):
            due[path] = stamp
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for path, status, output in pool.map(lambda name: check(name, build_folder), due):
            if status == 0:
                open(due[path], "w").close()
            else:
                print(output)
                failures += 1
    print(f"{len(files)} files, {len(due)} checked now, {failures} with findings")
    return 1 if failures else 0


sys.exit(main())
