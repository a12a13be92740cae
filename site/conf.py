"""Sphinx's settings for the course's site. `./roslings site` builds with them."""

import os
import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path[:0] = [str(HERE), *map(str, HERE.parent.glob("packages/*/src"))]

from course_site import course_digest, theme_colours  # noqa: E402  found by the line above

from ros2_on_pip.language import VARIABLE, said, speak  # noqa: E402
from ros2_on_pip.language import language as asked_for  # noqa: E402
from roslings.report.html.document import MARK  # noqa: E402

# For the cells of the lessons: the quiz has a page of its own here, and nobody's work is checked.
os.environ["ROSLINGS_SITE"] = "1"
os.environ["ROSLINGS_WS"] = str(HERE / "no_workspace")

project = "roslings"
author = "the roslings authors"

# The site is in one language. What cells print stays as it is recorded: it is code.
language = asked_for()
speak(language)
os.environ.pop(VARIABLE, None)
copyright = said("site.copyright", "the roslings authors, CC BY 4.0")
locale_dirs = [os.environ.get("ROSLINGS_LOCALES", "locales")]
gettext_compact = False
gettext_location = True

extensions = ["myst_nb", "course_site"]
course_root = os.environ["ROSLINGS_COURSE"]
course_digest = course_digest(Path(course_root))

# Notebooks are run by the build, so that what the page shows is what really happens.
nb_execution_mode = "cache"
nb_execution_cache_path = os.environ.get("ROSLINGS_CELLS", "")
nb_execution_raise_on_error = True
nb_execution_timeout = 60
nb_execution_show_tb = True
nb_merge_streams = True
nb_render_error_lexer = "none"  # our errors are sentences: "and" in one is no keyword
# `./roslings lab` writes a kernel of this name; here the one that came with ipykernel does.
nb_kernel_rgx_aliases = {"roslings": "python3"}
nb_ipywidgets_js = {}  # these come from another host
myst_enable_extensions = ["colon_fence", "deflist", "fieldlist", "attrs_inline"]
myst_heading_anchors = 4
suppress_warnings = ["myst.strikethrough"]

html_theme = "furo"
html_title = "roslings"
html_static_path = ["static"]
templates_path = ["templates"]
html_logo = html_favicon = str(MARK)
html_css_files = ["course.css"]
# Plain scripts in this order: module scripts do not load from file://.
html_js_files = [(name, {"defer": "defer"}) for name in ("progress.js", "words.js", "page.js")]
html_use_index = False
html_copy_source = False
html_show_sourcelink = False
html_show_sphinx = False
html_show_search_summary = False  # it fetches pages, which file:// forbids
html_math_renderer = "none"  # the usual one loads from another host
html_permalinks_icon = "#"
pygments_style = "a11y-high-contrast-light"
pygments_dark_style = "a11y-high-contrast-dark"

_MONO = "ui-monospace, 'DejaVu Sans Mono', 'Cascadia Mono', Menlo, Consolas, monospace"
_SANS = "system-ui, -apple-system, 'Segoe UI', Roboto, 'Noto Sans', 'DejaVu Sans', sans-serif"
html_theme_options = {
    "navigation_with_keys": False,  # arrow keys belong to the quizzes
    "light_css_variables": {
        "font-stack": _SANS,
        "font-stack--monospace": _MONO,
        "color-brand-visited": "#4d3a86",
        **theme_colours("light"),
    },
    "dark_css_variables": {"color-brand-visited": "#c3b1f5", **theme_colours("dark")},
}
