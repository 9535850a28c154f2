# SPDX-License-Identifier: GPL-2.0-or-later
"""In a notebook: cells that are a scene, claims or a derivation, and the page that moves.

    %load_ext alembert

    %%alembert scene pendulum       # the cell is the text of a scene, which the name then stands for
    %%alembert check pendulum       # the cell is claims, one a line
    %%alembert mark pendulum        # the cell is a derivation in LaTeX, Markdown or plain text

    pendulum.live()                 # the figure that moves, with sliders for parameters
"""

import html as _html

from . import _alembert
from ._results import Result
from ._scene import Scene

USAGE = "expected '%%alembert scene NAME', '%%alembert check NAME' or '%%alembert mark NAME'"

#: The widget's half in the browser: the page in a frame, and its state at the time that Python asks for.
_SHOWN_BY = """
function render({ model, el }) {
  const frame = document.createElement("iframe");
  frame.style = "width: 100%; border: 0; height: " + model.get("height") + "px";
  frame.title = model.get("title");
  frame.srcdoc = model.get("page");
  // The page has a motion of its own when a slider or a body was moved.
  const answer = () => {
    const page = frame.contentWindow && frame.contentWindow.alembert;
    model.set("state", (page && page.state(model.get("time"))) || []);
    model.save_changes();
  };
  frame.addEventListener("load", () => {
    for (const moved of ["input", "change", "pointerup"])
      frame.contentDocument.addEventListener(moved, () => setTimeout(answer, 100));
  });
  model.on("change:time", answer);
  el.append(frame);
}
export default { render };
"""


class Live(Result):
    """The page of a scene, whose figure moves and has sliders: shown in a frame, `.html` is its text.

    `.widget()` is the same as a widget (needs anywidget, from PyPI). When a slider or a body is moved, and when `time` is
    set, its `state` becomes that of the motion shown at that time; it is empty while the motion is that of `simulate`."""

    def __init__(self, page, name, height):
        super().__init__({"name": name, "height": height}, f"the live page of {name}")
        self.html = page

    def _repr_html_(self):
        return (f'<iframe title="{_html.escape(self.name)}" style="width: 100%; border: 0; height: {self.height}px" '
                f'srcdoc="{_html.escape(self.html)}"></iframe>')  # yapf: disable

    def widget(self):
        """The page as a widget of anywidget, with `time` and `state`."""
        try:
            import anywidget
            import traitlets
        except ImportError as missing:
            raise _alembert.EnvironmentFailure(
                "a widget needs the package anywidget, which is not installed: pip install anywidget") from missing

        class LiveWidget(anywidget.AnyWidget):
            _esm = _SHOWN_BY
            page = traitlets.Unicode().tag(sync=True)
            title = traitlets.Unicode().tag(sync=True)
            height = traitlets.Int().tag(sync=True)
            time = traitlets.Float().tag(sync=True)
            state = traitlets.List(trait=traitlets.Float()).tag(sync=True)

        return LiveWidget(page=self.html, title=self.name, height=self.height)


def _told(mistake):
    """The mistake, so that a notebook shows its text without the calls that led to it."""
    text = f"{type(mistake).__name__}: {mistake}"
    mistake._render_traceback_ = lambda: text.splitlines()
    return mistake


def cell(names, line, text):
    """What a cell `%%alembert LINE` with this text gives; `names` are the variables of the notebook."""
    words = line.split()
    if len(words) != 2 or words[0] not in ("scene", "check", "mark"):
        raise ValueError(f"found '%%alembert {line.strip()}'; {USAGE}")
    verb, name = words
    if not name.isidentifier():
        raise ValueError(f"{name!r} is no name of a variable; {USAGE}")
    if verb == "scene":
        scene = Scene(text=text, name=f"{name}.toml")
        scene.derive()
        names[name] = scene
        return scene
    if not isinstance(names.get(name), Scene):
        raise ValueError(f"there is no scene {name!r} in this notebook; give one before, by '%%alembert scene {name}'")
    return names[name].check(text) if verb == "check" else names[name].mark(text)


def load_ipython_extension(shell):
    """What %load_ext alembert calls."""
    from IPython.display import display

    def alembert(line, text):
        try:
            result = cell(shell.user_ns, line, text)
            if isinstance(result, Scene):
                display(result.draw())
        except (_alembert.Error, ValueError) as mistake:
            raise _told(mistake)  # noqa: B904 (the calls are not shown)
        return result

    alembert.__doc__ = __doc__
    shell.register_magic_function(alembert, magic_kind="cell")
