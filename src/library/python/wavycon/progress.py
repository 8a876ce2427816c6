"""Bars of progress, where tqdm is installed."""
import time
from typing import Any

PATIENCE = 1.0   # seconds before a solve shows its progress


def new_bar(total: int, unit: str) -> Any:
    """A bar; None without tqdm."""
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return None
    return tqdm(total=total, unit=unit)


class Watch:
    """What the library calls while it solves loads: it shows a bar if they take long, and says whether to stop."""

    def __init__(self, loads: int) -> None:
        self.loads, self.solved, self.is_stopped = loads, 0, False   # no bar of 0 loads
        self.bar: Any = None
        self.begin = time.monotonic() + PATIENCE

    def __call__(self, _: object, iterations: int, residual: float) -> bool:
        if self.loads and self.bar is None and time.monotonic() > self.begin:
            self.bar = new_bar(self.loads, "load")
            self.loads = 0
        if self.bar is not None:
            self.bar.set_postfix_str(f"{iterations} iterations, residual {residual:.0e}", refresh=False)
            self.bar.update(self.solved - self.bar.n)
        return self.is_stopped

    def end(self) -> None:
        if self.bar is not None:
            self.bar.update(self.solved - self.bar.n)
            self.bar.close()
