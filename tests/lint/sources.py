# The files that lint looks at: the source tree without what is built or installed into it, and
# without what others wrote (vendor).
import os

SKIPPED_FOLDERS = {".git", "build", "node_modules", "shared", "vendor", "__pycache__"}


def all_files():
    """Paths relative to the root, sorted."""
    found = []
    for folder, subfolders, names in os.walk("."):
        subfolders[:] = sorted(name for name in subfolders if name not in SKIPPED_FOLDERS)
        found += [os.path.normpath(os.path.join(folder, name)) for name in names]
    return sorted(found)


def files_under(folders, extensions):
    return [path for path in all_files()
            if path.startswith(tuple(folder + "/" for folder in folders))
            and path.endswith(tuple(extensions))]
