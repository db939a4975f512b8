# lint.house: what the house rules say and no other tool checks.
import re
import subprocess
import sys

import sources

LONGEST_FILE = 400  # lines
CODE = (".h", ".cpp", ".glsl", ".comp", ".py", ".js", ".mjs", ".css", ".html", ".cmake", ".sh")
SHADERS = (".glsl", ".comp")
TEXT = CODE + (".md", ".txt", ".json", ".in")
SCRIPTS = ("run", "test", ".ci/run")
OPENINGS = {".py": "#", ".cmake": "#", ".sh": "#", ".css": "/*", ".html": "<!"}

# Spelled in parts, so that this file does not break its own rules.
LEFT_UNDONE = re.compile(r"\b(?:TO" r"DO|FIX" r"ME|XX" r"X)\b")
MACHINE_PATH = re.compile(r"(?<![\w.])/(?:work|home|root|tmp|Users)" r"/[\w.]")


def extension(path):
    return path[path.rfind("."):]


def findings_in(path, text):
    lines = text.split("\n")
    if path.endswith(CODE):
        if len(lines) - 1 > LONGEST_FILE:
            yield len(lines), f"more than {LONGEST_FILE} lines"
        opening = OPENINGS.get(extension(path), "//")
        first = lines[1] if lines[0].startswith("#!") else lines[0]
        if not first.startswith(opening):
            yield 1, f"does not open with a {opening} comment on what the file is for"
    if text and not text.endswith("\n"):
        yield len(lines), "no newline at the end"
    for number, line in enumerate(lines, 1):
        if "\t" in line:
            yield number, "a tab"
        if line != line.rstrip():
            yield number, "space at the end of the line"
        if LEFT_UNDONE.search(line):
            yield number, "work left undone belongs in an issue"
        if MACHINE_PATH.search(line):
            yield number, "the path of some machine"


def main():
    failures = 0
    files = sources.all_files()
    assert "CMakeLists.txt" in files, "not run from the root of the source tree"
    for path in files:
        if path.endswith(TEXT) or path in SCRIPTS:
            if path.endswith("package-lock.json"):
                continue
            with open(path, encoding="utf-8") as file:
                for number, message in findings_in(path, file.read()):
                    print(f"{path}:{number}: {message}")
                    failures += 1
    for path in files:
        if path in SCRIPTS or path.endswith(".sh"):
            failures += subprocess.run(["bash", "-n", path]).returncode != 0
    return 1 if failures else 0


sys.exit(main())
