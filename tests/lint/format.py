# lint.format: C++ is laid out as .clang-format says.
import subprocess
import sys

import sources

files = sources.files_under(["server", "protocol", "client", "lab", "tests", "shaders/shared"],
                            [".h", ".cpp"])
assert files, "not run from the root of the source tree"
sys.exit(subprocess.run(["clang-format", "--dry-run", "-Werror", *files]).returncode)
