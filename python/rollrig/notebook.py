"""What Jupyter shows: the page of a result, and the progress of a call."""

from __future__ import annotations

import contextlib
import html
import math
import sys
import time
from collections.abc import Callable, Iterator
from typing import Any, Union

from .settings import wrong_type

Show = Callable[[float, str], object]
Progress = Union[bool, Show, None]
"""progress=: True shows a bar, False none; None (default) shows a bar in Jupyter alone. A function is called with the
share done (0 to 1, NaN if unknown) and the stage as text."""

FIRST_AFTER_S = 0.5  # Assumed: what ends sooner needs no bar


def frame(page: str | None, text: str, height_px: int = 640) -> str:
    """The page in a frame of its own, so that it and the notebook do not disturb each other; else the text."""
    if page is None:
        return f"<pre>{html.escape(text)}</pre>"
    return (f'<iframe srcdoc="{html.escape(page)}" sandbox="allow-scripts allow-downloads" '
            f'style="width:100%;height:{height_px}px;border:1px solid #ccc;resize:vertical"></iframe>')


def is_in_notebook() -> bool:
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    return shell is not None and hasattr(shell, "kernel")


class NotebookBar:
    """A bar below the cell, which goes when the call ends."""

    def __init__(self) -> None:
        self.start_s = time.monotonic()
        self.handle: Any = None

    def __call__(self, done: float, stage: str) -> None:
        if time.monotonic() - self.start_s < FIRST_AFTER_S:
            return
        from IPython.display import HTML, display

        value = "" if math.isnan(done) else f' value="{done:.3f}"'
        share = "" if math.isnan(done) else f"{100 * done:.0f} %"
        shown = HTML(f"<progress{value}></progress> {share} {html.escape(stage)}")
        if self.handle is None:
            self.handle = display(shown, display_id=True)
        else:
            self.handle.update(shown)

    def close(self) -> None:
        if self.handle is not None:
            from IPython.display import HTML

            self.handle.update(HTML(""))


class TerminalLine:
    """One line on standard error, which goes when the call ends."""

    def __init__(self) -> None:
        self.shown = 0

    def __call__(self, done: float, stage: str) -> None:
        text = (stage if math.isnan(done) else f"{100 * done:3.0f} % {stage}")[:78]
        print("\r" + text.ljust(self.shown), end="", file=sys.stderr, flush=True)
        self.shown = len(text)

    def close(self) -> None:
        if self.shown:
            print("\r" + " " * self.shown + "\r", end="", file=sys.stderr, flush=True)


@contextlib.contextmanager
def progress_display(progress: Progress) -> Iterator[Show | None]:
    """What the library calls with the progress of a call; None where nothing is to be shown."""
    if callable(progress):
        yield progress
    elif not (progress is None or isinstance(progress, bool)):
        raise wrong_type("progress", "True, False, None or a function is expected", progress)
    elif progress is False or (progress is None and not is_in_notebook()):
        yield None
    else:
        bar: NotebookBar | TerminalLine = NotebookBar() if is_in_notebook() else TerminalLine()
        try:
            yield bar
        finally:
            bar.close()
