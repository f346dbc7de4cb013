"""Lets the system refuse one call of a run after the other (strace's fault injection), and looks at what is left."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

PROGRAM = Path(sys.argv[1]).resolve()
STEP = int(sys.argv[2])

# The calls that change what is on the disk, and what the system may answer.
CALLS = {
    "write": ["ENOSPC", "EDQUOT", "EIO"],
    "openat": ["ENOSPC", "EACCES", "EROFS"],
    "mkdir": ["ENOSPC", "EROFS"],
    "rename,renameat,renameat2": ["EACCES", "ENOSPC"],
    "link,linkat": ["EPERM", "ENOSPC"],
    "unlink,unlinkat,rmdir": ["EACCES", "EIO"],
    "fsync,fdatasync": ["EIO", "EDQUOT"],
    "flock": ["ENOLCK"],
    "copy_file_range,sendfile": ["ENOSPC"],
    "newfstatat,statx,fstat": ["EIO"],
    "getdents64": ["EIO"],
    "pread64,read": ["EIO"],
}

SCENARIO = """
[plan]
image = "plan.pgm"
metres_per_pixel = 0.1

[texture]
floor_texels_per_metre = 10
wall_texels_per_metre = 10
tile = 128

[crowd]
people = 4
days = 2
"""

RUNS = {
    "bake": ["bake", "plan.toml", "--seed", "2", "--force", "-o", "out"],
    "resolve": ["resolve", "out", "--preset", "wet"],
    "merge": ["merge", "parts", "--force", "-o", "out"],
}


def trodden(folder, *arguments, before=()):
    command = [*before, PROGRAM, *arguments, "--quiet", "--threads", "1"]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=60)


def files(folder):
    """All files of a bake; its report differs from run to run."""
    found = {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}
    found.pop("report.json", None)
    return found


def sandbox(base, place):
    shutil.rmtree(place, ignore_errors=True)
    shutil.copytree(base, place, copy_function=os.link)
    return place


def numbers(folder, arguments, calls):
    """Which calls of a kind, counted in each thread, are on files of the folder."""
    log = folder.parent / "calls"
    trodden(folder, *arguments, before=["strace", "-f", "-y", "-o", str(log), "-e", f"trace={calls}"])
    counted, wanted = {}, set()
    for line in log.read_text(errors="replace").splitlines():
        thread, call = line.split(None, 1)
        if not re.match(r"[a-z0-9_]+\(", call):
            continue
        counted[thread] = counted.get(thread, 0) + 1
        reads = call.startswith("openat(") and "O_CREAT" not in call and "O_WRONLY" not in call and "O_RDWR" not in call
        if (str(folder) in call or re.search(r'"(out|parts|\.out)', call)) and not (reads and calls == "openat"):
            wanted.add(counted[thread])
    return sorted(wanted)


def check(name, arguments, base, work):
    old = files(base / "out")
    place = sandbox(base, work / "place")
    done = trodden(place, *arguments)
    assert done.returncode == 0, done.stderr
    new, names = files(place / "out"), sorted(os.listdir(place))
    assert new != old and names == sorted(os.listdir(base))
    points = failures = 0
    for calls, errors in CALLS.items():
        for number in numbers(sandbox(base, place), arguments, calls)[:: STEP]:
            points += 1
            error = errors[number % len(errors)]
            where = f"{name}: call {number} of {calls} answers {error}"
            folder = sandbox(base, place)
            injected = ["strace", "-f", "-qq", "-o", "/dev/null", "-e", f"trace={calls}"]
            injected += ["-e", f"inject={calls}:error={error}:when={number}"]
            ran = trodden(folder, *arguments, before=injected)
            problem = None
            left = files(folder / "out") if (folder / "out").is_dir() else None
            if ran.returncode == 0:
                if left != new:
                    problem = "it ended well, but the new result is not whole"
            elif ran.returncode != 1 or "panicked" in ran.stderr:
                problem = "neither success nor an error"
            elif sum(line.startswith("error: ") for line in ran.stderr.splitlines()) != 1:
                problem = "not one error"
            elif not re.search(r"\b(out|parts|plan)\b", ran.stderr):
                problem = "the error names no file"
            elif left not in (old, new) and not (left is None and (folder / ".out.old").is_dir()):
                problem = "the earlier result is not whole"
            failures += ran.returncode != 0
            again = trodden(folder, *arguments)
            if not problem and again.returncode != 0:
                problem = "the next run fails"
            elif not problem and (files(folder / "out") != new or sorted(os.listdir(folder)) != names):
                problem = f"the next run does not clean up: {sorted(os.listdir(folder))}"
            if problem:
                yield f"{where}: {problem}\n{ran.stderr}{again.stderr}"
    print(f"faults: {name}: {points} calls refused, {failures} runs ended with an error")


def main():
    with tempfile.TemporaryDirectory() as work:
        work = Path(work).resolve()
        base = work / "base"
        base.mkdir()
        rows = [bytes(255 if 5 <= y < 35 else 0 for _ in range(80)) for y in range(40)]
        (base / "plan.pgm").write_bytes(b"P5 80 40 255\n" + b"".join(rows))
        (base / "plan.toml").write_text(SCENARIO)
        for arguments in (
            ["bake", "plan.toml", "-o", "out"],
            ["bake", "plan.toml", "--seed", "3", "--days", "1..1", "--part-of", "parts"],
            ["bake", "plan.toml", "--seed", "3", "--days", "2..2", "--part-of", "parts"],
        ):
            made = trodden(base, *arguments)
            assert made.returncode == 0, made.stderr
        wrong = 0
        # Most of the time is strace's: the runs go side by side.
        with ThreadPoolExecutor() as threads:
            for problems in threads.map(lambda name: list(check(name, RUNS[name], base, work / name)), RUNS):
                for problem in problems:
                    wrong += 1
                    print(problem, flush=True)
    sys.exit(bool(wrong))


main()
