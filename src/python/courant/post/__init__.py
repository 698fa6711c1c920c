"""`courant post`: measures in the results of a run what a recipe asks for. See docs/post.md.

Importing it registers the kinds of analyses; `analysis` and `chart` register more.
"""

from ..tables import Column, Table
from . import kinds_roller, kinds_series, kinds_states
from .analysis import KINDS, Analysis, Run, Settings, TimeWindow, analysis
from .figures import chart
from .recipe import Recipe, read_recipe
from .run import run_post
from .tables import Image, Result, Scalar, Series

_ORDER = "probe surface grid profile spectrum flux history force toe roller".split()  # as messages name them
KINDS.functions = {kind: KINDS[kind] for kind in _ORDER}
__all__ = ["Analysis", "Column", "Image", "Recipe", "Result", "Run", "Scalar", "Series", "Settings", "Table", "TimeWindow", "analysis", "chart"]
__all__ += ["kinds_roller", "kinds_series", "kinds_states", "read_recipe", "run_post"]
