"""Runs the trodden program and reads what it prints. Knows nothing of Blender."""

import codecs
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

# A bar on a terminal: stage, bar, percent.
BAR = re.compile(r"([a-z]+) [━╌]+ +([0-9]+) %")
ESCAPES = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]")
# How far the whole work is once a stage runs, as measured on the sample plans.
STAGES = {
    "plan": 0.0, "walls": 0.03, "routes": 0.05, "patterns": 0.1, "motion": 0.12, "crowd": 0.12, "marks": 0.12,
    "stamps": 0.12, "sums": 0.35, "look": 0.4, "export": 0.4, "scene": 0.75, "stills": 0.77, "page": 0.88, "done": 1.0,
}


def find(chosen=""):
    """The path of the program: the chosen one, the one on the PATH, or the one that Cargo has installed."""
    if chosen:
        return chosen if Path(chosen).is_file() else None
    name = "trodden.exe" if sys.platform == "win32" else "trodden"
    installed = Path.home() / ".cargo" / "bin" / name
    return shutil.which("trodden") or (str(installed) if installed.is_file() else None)


def scenario(plan, metres_per_pixel=None, people=400, seed=1, use=None, preset="commuters", material="vinyl",
             total_passes=20000):
    """A scenario file's text. Paths are quoted as JSON, whose strings TOML reads."""
    lines = ["[plan]", f"image = {json.dumps(str(plan), ensure_ascii=False)}"]
    if metres_per_pixel:
        lines.append(f"metres_per_pixel = {metres_per_pixel:.9g}")
    lines += ["", "[crowd]", f'preset = "{preset}"', f"people = {people}", f"seed = {seed}"]
    if use:
        lines += ["", "[life]", f'use = "{use}"']
    lines += ["", "[look]", f"total_passes = {total_passes}", "", "[look.floor]", f'material = "{material}"', ""]
    return "\n".join(lines)


class Run:
    """A bake that runs beside Blender. `share` and `stage` tell how far it is."""

    def __init__(self, command):
        self.share, self.stage, self.text = 0.0, "", ""
        self.cancelled = False
        self.started = time.monotonic()
        read, write = self._channel()
        windows = sys.platform == "win32"
        options = {"creationflags": subprocess.CREATE_NO_WINDOW} if windows else {"start_new_session": True}
        self.process = subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=write or subprocess.PIPE, **options)
        if write:
            os.close(write)
        self.source = os.fdopen(read, "rb", buffering=0) if read else self.process.stderr
        self.reader = threading.Thread(target=self._read, daemon=True)
        self.reader.start()

    @staticmethod
    def _channel():
        """A terminal, since the program shows its bars on nothing else; nothing where there is no such thing."""
        if sys.platform == "win32":
            return None, None
        import fcntl
        import pty
        import struct
        import termios
        read, write = pty.openpty()
        # Wide, so that no bar and no message is wrapped.
        fcntl.ioctl(write, termios.TIOCSWINSZ, struct.pack("HHHH", 50, 1000, 0, 0))
        return read, write

    def _read(self):
        decoder = codecs.getincrementaldecoder("utf-8")("replace")
        while True:
            try:
                piece = self.source.read(4096)
            except OSError:  # a terminal whose other end is closed
                break
            if not piece:
                break
            self.text = (self.text + decoder.decode(piece))[-100_000:]
            for stage, percent in BAR.findall(ESCAPES.sub("", self.text[-4000:])):
                self._advance(stage, int(percent) / 100)
        self.source.close()

    def _advance(self, stage, share):
        start = STAGES.get(stage)
        if start is None:
            return
        end = min(value for value in STAGES.values() if value > start)
        whole = start + (end - start) * share
        # Stages overlap; a bar that goes back would say nothing.
        if whole > self.share:
            self.share, self.stage = whole, stage

    def running(self):
        return self.process.poll() is None

    def said(self):
        """The stage, if the program shows it, and the time so far."""
        return " ".join(filter(None, (self.stage, f"{time.monotonic() - self.started:.0f} s")))

    def cancel(self):
        """Asks the program to stop, as Ctrl-C does: it leaves nothing behind."""
        self.cancelled = True
        if not self.running():
            return
        if sys.platform == "win32":
            # Ctrl-C reaches only programs of the same console, and Blender has none.
            self.process.terminate()
        else:
            self.process.send_signal(signal.SIGINT)

    def end(self, patience=10.0):
        """Waits for the end of a cancelled run, and forces it if it does not come."""
        try:
            self.process.wait(patience)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()

    def messages(self):
        """What the program said: (errors with their hints, warnings)."""
        self.reader.join(5.0)
        errors, warnings, target = [], [], None
        for line in re.split(r"[\r\n]+", ESCAPES.sub("", self.text)):
            line = line.strip()
            if line.startswith("error:"):
                target = errors
                errors.append(line[6:].strip())
            elif line.startswith("warning:"):
                target = warnings
                warnings.append(line[8:].strip())
            elif line.startswith("hint:") and target is not None:
                target[-1] += f". Hint: {line[5:].strip()}"
            elif errors and target is errors and line and not BAR.search(line):
                target[-1] += f" {line}"
        return errors, warnings
