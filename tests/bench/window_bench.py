"""Benchmarks of the window: what a person waits for. Used by scripts/bench.

The real window runs under Xvfb, and xdotool moves the mouse and presses keys. The window writes what
each turn of its loop took (--turn-log, see app/viewer/turn_log.h). A turn begins at its first event and
ends when its frame is submitted and everything else is done. Of that, `own_ms` leaves out the waits for
the GPU, which lavapipe spends rasterizing on the same cores, and `cpu_ms` is the processor time of the
main thread alone, which other programs on the machine do not change.
"""
import json
import os
import pathlib
import statistics
import subprocess
import tempfile
import time

PATIENCE_S = 120.0
QUIET_S = 0.4
IDLE_S = 10.0
# The model may be seen through the middle of the window, beside the panels.
MIDDLE = (640, 400)

GESTURES = {
    "gesture_orbit": "orbit: a drag of ten moves",
    "gesture_pan": "pan: a drag of ten moves",
    "gesture_zoom": "zoom: a step of the wheel",
    "gesture_hover": "pick: ten moves of the mouse over the edges, in crease mode",
    "gesture_select": "select an edge: a click in crease mode",
    "gesture_detail": "slider of detail: a drag over a quarter of it, progressive mesh",
    "gesture_simplify": "simplify by a tenth (d), until the result is shown",
    "gesture_undo": "undo of that",
    "gesture_redo": "redo of that",
    "gesture_shading": "change the shading",
    "gesture_wireframe": "show or hide the wireframe",
    "gesture_tool": "another tool",
    "gesture_menu": "open a menu by a click",
    "gesture_palette": "open the list of commands",
    "gesture_tab": "show another model",
}
OTHERS = {
    "window_idle": f"processor time of an idle window in {IDLE_S:.0f} s",
    "window_memory": "an edit and its undo, in batches of 20",
    "window_open": "13 million faces (PLY): from the start of the process until its window has a picture",
}
MEMORY_AFTER = (100, 500, 1000)


class Window:
    """A running window, on a model that is already open."""

    def __init__(self, program, display, arguments):
        self.home = tempfile.TemporaryDirectory()
        home = pathlib.Path(self.home.name)
        self.turns_file, self.state_file = home / "turns.jsonl", home / "state.jsonl"
        self.environment = dict(os.environ, DISPLAY=display, XDG_STATE_HOME=str(home),
                                XDG_CONFIG_HOME=str(home / "config"), XDG_PICTURES_DIR=str(home),
                                DBUS_SESSION_BUS_ADDRESS="unix:path=/nonexistent")
        self.environment.pop("WAYLAND_DISPLAY", None)
        self.seen = 0
        self.started_s = time.monotonic()
        self.process = subprocess.Popen(
            [program, "view", *arguments, "--turn-log", self.turns_file, "--state-log",
             self.state_file], env=self.environment, stderr=subprocess.DEVNULL)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        self.home.cleanup()

    def xdotool(self, *words):
        return subprocess.run(["xdotool", *[str(word) for word in words]], env=self.environment,
                              check=True, stdout=subprocess.PIPE, text=True,
                              timeout=PATIENCE_S).stdout

    def focus(self):
        turns = []
        end_s = time.monotonic() + PATIENCE_S
        while not turns:  # until it has drawn, it may not be there to be focused
            if time.monotonic() > end_s:
                raise SystemExit("bench: the window does not appear")
            time.sleep(0.05)
            turns = self.new_turns()
        window = self.xdotool("search", "--sync", "--name", "mesher").split()[0]
        self.xdotool("windowfocus", "--sync", window)

    def new_turns(self):
        """The turns since the last call."""
        if not self.turns_file.exists():
            return []
        with open(self.turns_file, encoding="utf-8") as file:
            file.seek(self.seen)
            text = file.read()
        whole = text[:text.rfind("\n") + 1]
        self.seen += len(whole)
        return [json.loads(line) for line in whole.splitlines()]

    def state(self):
        lines = self.state_file.read_text(encoding="utf-8").splitlines()
        return json.loads(lines[-1])

    def settle(self):
        """Waits until the window has been quiet for a while. Returns the turns until then."""
        turns = self.new_turns()
        end_s, quiet_since_s = time.monotonic() + PATIENCE_S, time.monotonic()
        is_busy = False
        while is_busy or time.monotonic() - quiet_since_s < QUIET_S:
            if time.monotonic() > end_s or self.process.poll() is not None:
                raise SystemExit("bench: the window does not come to rest")
            time.sleep(0.02)
            new = self.new_turns()
            turns += new
            if new:
                quiet_since_s = time.monotonic()
                is_busy = new[-1]["job"] is not None
        return turns

    def place_of(self, widget):
        for name, (left, top, right, bottom) in self.state()["widgets"].items():
            if widget in name:
                return (left + right) / 2, (top + bottom) / 2, right - left
        raise SystemExit(f"bench: the window has no widget {widget}")

    def move(self, x, y):
        self.xdotool("mousemove", int(x), int(y))

    def drag(self, button, start, step, moves=10):
        self.move(*start)
        self.xdotool("mousedown", button)
        for i in range(1, moves + 1):
            self.move(start[0] + i * step[0], start[1] + i * step[1])
            time.sleep(0.03)
        self.xdotool("mouseup", button)

    def click(self, x, y):
        self.move(x, y)
        time.sleep(0.1)  # the panels have to see the pointer first
        self.xdotool("click", 1)

    def key(self, *keys):
        self.xdotool("key", *keys)

    def cpu_s(self):
        """Processor time of all threads."""
        tasks = pathlib.Path(f"/proc/{self.process.pid}/task").glob("*/schedstat")
        return sum(int(task.read_text().split()[0]) for task in tasks) / 1e9

    def memory_mb(self):
        for line in pathlib.Path(f"/proc/{self.process.pid}/status").read_text().splitlines():
            if line.startswith("VmRSS"):
                return int(line.split()[1]) / 1024
        return 0.0


def open_window(program, display, *models):
    window = Window(program, display, [models[0], "--size", "1280x800"])
    window.focus()
    window.settle()
    return window


def measure_gesture(window, act, repetitions, before=None):
    """The longest turn of each repetition."""
    row = {"ms": [], "first_ms": [], "longest_own_ms": [], "longest_cpu_ms": []}
    for turn in range(repetitions + 1):
        if before:
            before(turn)
        window.settle()
        act(turn)
        turns = window.settle()
        if not turns:
            raise SystemExit("bench: the window has not seen a gesture")
        longest_ms = max(t["own_ms"] for t in turns)
        if turn == 0:  # creates pipelines and fills caches
            row["first_ms"].append(longest_ms)
        else:
            row["ms"].append(longest_ms)
            row["longest_cpu_ms"].append(max(t["cpu_ms"] for t in turns))
    row["longest_own_ms"] = [max(row["ms"])]
    row["longest_cpu_ms"] = [max(row["longest_cpu_ms"])]
    return row


def gestures(window, other):
    """Task: what is done before each repetition, and the gesture."""
    sign = lambda turn: 1 if turn % 2 else -1

    def slider(turn):
        x, y, width = window.place_of("detail/slider")
        window.drag(1, (x + (0.45 if turn % 2 else 0.2) * width, y), (-sign(turn) * 0.025 * width, 0))

    def tool_widget(turn):
        window.key("ctrl+2" if turn % 2 else "ctrl+3")

    yield "gesture_orbit", None, lambda turn: window.drag(1, MIDDLE, (8 * sign(turn), 3))
    yield "gesture_pan", None, lambda turn: window.drag(3, MIDDLE, (6 * sign(turn), 4 * sign(turn)))
    yield "gesture_zoom", None, lambda turn: (window.move(*MIDDLE),
                                              window.xdotool("click", 4 if turn % 2 else 5))
    yield "gesture_shading", None, lambda turn: window.key("g")
    yield "gesture_wireframe", None, lambda turn: window.key("w")
    yield "gesture_tool", None, tool_widget
    yield ("gesture_menu", lambda turn: window.key("Escape"),
           lambda turn: window.click(*window.place_of("/menu ")[:2]))
    yield "gesture_palette", lambda turn: window.key("Escape"), lambda turn: window.key("ctrl+k")
    window.key("Escape")
    yield "gesture_simplify", lambda turn: window.key("ctrl+z"), lambda turn: window.key("d")
    yield "gesture_undo", lambda turn: window.key("d"), lambda turn: window.key("ctrl+z")
    yield "gesture_redo", lambda turn: window.key("ctrl+z"), lambda turn: window.key("ctrl+y")
    window.key("ctrl+z")
    window.key("c")
    hover = lambda turn: [(window.move(MIDDLE[0] + 7 * i * sign(turn), MIDDLE[1] - 5 * i),
                           time.sleep(0.03)) for i in range(10)]
    yield "gesture_hover", None, hover
    yield "gesture_select", None, lambda turn: window.click(MIDDLE[0] + 3 * turn, MIDDLE[1])
    window.key("c")
    window.key("p")
    window.settle()
    yield "gesture_detail", None, slider
    window.key("p")
    if other:
        window.key("ctrl+o")
        window.settle()
        window.xdotool("type", "--delay", "30", other)
        window.settle()
        window.key("Return")
        window.settle()
        yield "gesture_tab", None, lambda turn: window.key("ctrl+Next")


def run_gestures(program, display, models, repetitions, chosen):
    wanted, results = chosen(GESTURES), {}
    if not wanted:
        return results
    with open_window(program, display, models / "armadillo.obj") as window:
        for task, before, act in gestures(window, str(models / "bunny.obj")):
            if task in wanted:
                results[task] = {"mesher": measure_gesture(window, act, repetitions, before)}
    return results


def run_idle(program, display, models, repetitions):
    with open_window(program, display, models / "armadillo.obj") as window:
        window.settle()
        spent = []
        for _ in range(min(repetitions, 3)):
            before_s = window.cpu_s()
            time.sleep(IDLE_S)
            spent.append(1000 * (window.cpu_s() - before_s))
    return {"ms": spent}


def run_memory(program, display, models, quick):
    row, last_s, done = {"ms": []}, time.monotonic(), 0
    with open_window(program, display, models / "armadillo.obj") as window:
        for count in MEMORY_AFTER[:1] if quick else MEMORY_AFTER:
            while done < count:
                # There has to be an edit before it can be undone. Faster, GLFW would take the keys
                # for repetitions of one that is held.
                window.key("--delay", "40", *["d"] * 20)
                window.settle()
                edits = window.state()["undo_depth"]
                window.key("--delay", "40", *["ctrl+z"] * 20)
                window.settle()
                if edits == 0 or window.state()["undo_depth"] != 0:
                    raise SystemExit("bench: an edit was not made or not undone")
                done += edits
                row["ms"].append(1000 * (time.monotonic() - last_s - 2 * QUIET_S) / edits)
                last_s = time.monotonic()
            row[f"mb_after_{count}"] = [window.memory_mb()]
    row["mb_grown"] = [row[f"mb_after_{MEMORY_AFTER[0 if quick else -1]}"][0]
                       - row[f"mb_after_{MEMORY_AFTER[0]}"][0]]
    return row


def longest_standstill_s(turns):
    """The longest time that the shown percentage stood still while a job ran."""
    longest, since, shown = 0.0, None, None
    for turn in turns:
        if turn["job"] is None:
            longest = max(longest, turn["end_s"] - since) if since else longest
            since = shown = None
            continue
        percent = int(100 * turn["fraction"])
        if shown != percent:
            longest = max(longest, turn["end_s"] - since) if since else longest
            since, shown = turn["end_s"], percent
    return longest


def run_open(program, display, large, repetitions):
    row = {"ms": [], "opened_s": [], "standstill_s": [], "longest_gap_ms": []}
    for _ in range(repetitions):
        with Window(program, display, [large, "--size", "1280x800"]) as window:
            turns = []
            end_s = time.monotonic() + PATIENCE_S
            while not turns or not turns[-1]["job"] is None or len(turns) < 3:
                if time.monotonic() > end_s:
                    raise SystemExit("bench: the model is not opened")
                time.sleep(0.05)
                turns += window.new_turns()
            opened_s = turns[-1]["end_s"]
            drawn = [turn["end_s"] for turn in turns if turn["drew"]]
            row["ms"].append(1000 * (drawn[0] - window.started_s))
            row["opened_s"].append(opened_s - window.started_s)
            row["standstill_s"].append(longest_standstill_s(turns))
            row["longest_gap_ms"].append(
                1000 * max(b - a for a, b in zip(drawn, drawn[1:])))
    return row


def run_cancel(bench_cancel, folder, kind, moments):
    done = subprocess.run([bench_cancel, kind, folder, str(moments)], check=True,
                          stdout=subprocess.PIPE, text=True)
    measured = json.loads(done.stdout)
    return {"ms": measured["cancel_ms"],
            "job_s": [measured["job_ms"] / 1000],
            "longest_cancel_ms": [max(measured["cancel_ms"])],
            "gone_ms": [statistics.median(measured["gone_ms"])],
            "longest_gone_ms": [max(measured["gone_ms"])]}
