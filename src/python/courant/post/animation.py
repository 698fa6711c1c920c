"""Moving pictures of a view: GIF by PIL, MP4 by ffmpeg."""

from __future__ import annotations

import io
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from ..files import write_by
from ..optional import module
from ..style import pyplot
from .camera import up_of
from .view_scene import View, colour_range, scene_of

_DPI = 80


class MissingProgram(Exception):
    """A program that is not there; the message states what to install."""


def _writer(kind: str, rate: float) -> Any:
    animation = module("matplotlib.animation")
    if kind == "gif":
        return animation.PillowWriter(fps=rate)
    if not animation.FFMpegWriter.isAvailable():
        raise MissingProgram("there is no MP4, which needs the program 'ffmpeg': apt-get install ffmpeg")
    return animation.FFMpegWriter(fps=rate)


def animate(run: Any, view: View, path: Path) -> Path:
    """Writes all states between the view's first and last time, of all states if it has none, with one range of colours.

    Frames have the look of the picture. Raises UnknownField, CourantError, MissingModule, MissingProgram.
    """
    from .views import draw_view

    writer = _writer(path.suffix[1:], view.rate)
    view = replace(view, columns=1, up=view.up or up_of(run, scene_of(run.states[-1], view).flat))
    times = run.states.times
    if view.times and len(view.times) > 1:
        times = times[(times >= min(view.times) - 1e-9) & (times <= max(view.times) + 1e-9)]
    ends = [scene_of(run.states.at(t), view) for t in np.unique(times[np.linspace(0, len(times) - 1, min(len(times), 8)).astype(int)])]
    limits = colour_range(ends, view)
    frames = []
    for t in times:
        # all looked-at states give the window, so that it is at rest; the one of this frame is drawn
        figure = draw_view(run, view, [scene_of(run.states.at(float(t)), view)], limits, ends)
        frame = io.BytesIO()
        figure.savefig(frame, format="png", dpi=_DPI)
        pyplot().close(figure)
        frames.append(module("matplotlib.pyplot").imread(io.BytesIO(frame.getvalue()))[..., :3])
    _write(writer, frames, path)
    return path


def _write(writer: Any, frames: list[np.ndarray], path: Path) -> None:
    plt = pyplot()
    height, width = frames[0].shape[:2]
    figure = plt.figure(figsize=(width / _DPI, height / _DPI), dpi=_DPI)
    image = figure.figimage(frames[0])

    def save(file: Path) -> None:
        with writer.saving(figure, str(file), _DPI):
            for frame in frames:
                image.set_data(frame)
                writer.grab_frame()

    write_by(save, path)
    plt.close(figure)
