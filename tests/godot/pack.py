"""Packs a Godot project into a PCK, as Godot's export does.

    pack.py PACKAGE FOLDER=PATH...

Files of FOLDER come to `res://PATH`. The form is version 2 of Godot's PCK (core/io/file_access_pack.h).
"""

import hashlib
import pathlib
import struct
import sys


def main(package, folders):
    files = {}
    for folder in folders:
        folder, path = folder.split("=")
        for file in sorted(pathlib.Path(folder).rglob("*")):
            if file.is_file():
                files["/".join(filter(None, ["res:/", path, file.relative_to(folder).as_posix()]))] = file.read_bytes()
    entries, offset = b"", 0
    for name, content in files.items():
        name = name.encode()
        name += b"\0" * (-len(name) % 4)
        entries += struct.pack("<I", len(name)) + name
        entries += struct.pack("<QQ16sI", offset, len(content), hashlib.md5(content).digest(), 0)
        offset += len(content)
    head = struct.pack("<4s5I", b"GDPC", 2, 4, 0, 0, 0)
    directory = struct.pack("<I", len(files)) + entries
    start = len(head) + 8 + 64 + len(directory)
    pathlib.Path(package).write_bytes(head + struct.pack("<Q64x", start) + directory + b"".join(files.values()))


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
