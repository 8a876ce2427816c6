"""Bars of progress, where tqdm is installed, and Ctrl-C."""
from __future__ import annotations

import signal
import threading
import time
from typing import Any

from . import library

PATIENCE = 1.0   # seconds before a solve shows its progress


def new_bar(total: int, unit: str, steps: Any = None, begun: float = 0.0) -> Any:
    """A bar, which began so many seconds ago, and through which steps go if they are given; None without tqdm."""
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return None
    bar = tqdm(steps, total=total, unit=unit, smoothing=0)
    bar.start_t -= begun
    return bar


class Watch:
    """What the library calls while it solves loads of a scene: it shows a bar if they take long. Ctrl-C ends the load
    that is being solved; KeyboardInterrupt follows at the end of `with`. An exception cannot leave a callback, so the
    signal must not raise one there. Signals come to the main thread alone."""

    def __init__(self, scene: library.Handle, loads: int) -> None:
        self.scene, self.loads, self.solved, self.is_stopped = scene, loads, 0, False   # no bar of 0 loads
        self.bar: Any = None
        self.begin = time.monotonic() + PATIENCE

    def __call__(self, _: object, iterations: int, residual: float) -> bool:
        if self.loads and self.bar is None and time.monotonic() > self.begin:
            self.bar = new_bar(self.loads, "load", begun=PATIENCE)
            self.loads = 0
        if self.bar is not None:
            self.bar.set_postfix_str(f"{iterations} iterations, residual {residual:.0e}", refresh=False)
            self.bar.update(self.solved - self.bar.n)
        return self.is_stopped

    def __enter__(self) -> Watch:
        self.ask = library.PROGRESS(self)
        library.call("set_progress", self.scene, self.ask, None)
        self.before = signal.getsignal(signal.SIGINT)
        self.is_main = threading.current_thread() is threading.main_thread() and callable(self.before)
        if self.is_main:
            signal.signal(signal.SIGINT, lambda *_: setattr(self, "is_stopped", True))
        return self

    def __exit__(self, *_: object) -> None:
        if self.is_main:
            signal.signal(signal.SIGINT, self.before)
        library.call("set_progress", self.scene, library.PROGRESS(), None)
        del self.ask   # which holds this object, and so the scene
        if self.bar is not None:
            self.bar.update(self.solved - self.bar.n)
            self.bar.close()
        if self.is_stopped:
            raise KeyboardInterrupt
