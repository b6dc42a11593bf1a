# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages that show frames: in a notebook, or as a file for any browser."""

import html
import os
import tempfile

from ._lodestone import BadArgument, Frame, PageBase, Pair


class Page(PageBase):
    """A page that shows the objects of a detector, frame by frame: surfaces, contacts, times.

        page = lodestone.Page(detector, title="Cloth")
        for vertices in simulation:
            detector.set_vertices(cloth, vertices)
            page.add(detector.detect())
        page.save("cloth.html")

    As the last line of a notebook's cell, it is shown there.
    """

    #: Height in a notebook, in pixels.
    height = 560

    def html(self):
        """The page as text."""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "page.html")
            self.save(path)
            with open(path, encoding="utf-8") as file:
                return file.read()

    def _repr_html_(self):
        return (
            f'<iframe srcdoc="{html.escape(self.html())}" width="100%" height="{self.height}" '
            'style="border: 0" sandbox="allow-scripts allow-downloads"></iframe>'
        )


def page(frames, path=None, *, title="Lodestone", frames_per_second=30.0):
    """Makes a page of frames as they are found, such as those of `play`, and saves it if there is a path.

    frames: an iterable of Frame, of one detector. Each is added before the next is asked for, since it shows the
    objects where they are then. So a list of frames that were kept is refused: give `play(...)` itself.
    """
    if path is not None and not os.fspath(path).lower().endswith(".html"):
        raise BadArgument(f"{os.fspath(path)}: a page is written as .html")  # before all frames are played
    made = None
    for frame in frames:
        if made is None:
            _check_has_detector(frame)
            made = Page(frame.detector, title=title, frames_per_second=frames_per_second)
        made.add(frame)
    if made is None:
        raise BadArgument("there are no frames")
    if path is not None:
        made.save(path)
    return made


def _check_has_detector(frame):
    if not isinstance(frame, Frame):
        hint = ": its frame is pair.frame" if isinstance(frame, Pair) else ""
        raise TypeError(f"a page is made of frames, but got {type(frame).__name__}{hint}")
    if frame.detector is None:
        raise BadArgument("only a frame of a Detector can be shown")


def _show(self):
    """A page of this frame, which a notebook shows. It must be the last that its detector found, and the
    objects must not have moved since. Numbers written into their arrays since then are not noticed."""
    _check_has_detector(self)
    made = Page(self.detector)
    made.add(self)
    return made


Frame.show = _show
