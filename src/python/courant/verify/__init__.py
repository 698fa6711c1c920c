"""`courant verify`: runs a suite of cases, compares what is observed with references, and tells what each setting costs.

A file of a user adds kinds of observations, numbers out of curves, reductions, norms and charts (`--load my.py`):

    from courant.verify import take

    @take("spread")
    def spread(series, at):
        return float(series.y.max() - series.y.min())
"""
from . import figures, observe, series  # noqa: F401  what they register can be named in suites
from .observe import Measured, NotFound
from .registry import chart, norm, observation, reduction, take
from .series import NoValue, Series

__all__ = ["Measured", "NoValue", "NotFound", "Series", "chart", "norm", "observation", "reduction", "take"]
