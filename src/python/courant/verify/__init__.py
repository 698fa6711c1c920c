"""`courant verify`: runs a suite of cases, compares what is observed with references, and states what each setting costs. A file of a user adds
kinds of observations, numbers out of curves, reductions, norms and charts (`--load my.py`); the user guide shows one."""
from . import figures, observe, series, surface, waves  # noqa: F401  what they register can be named in suites
from .figures import Figure
from .observe import Measured, NotFound
from .registry import chart, norm, observation, reduction, take
from .series import NoValue, Series

__all__ = ["Figure", "Measured", "NoValue", "NotFound", "Series", "chart", "norm", "observation", "reduction", "take"]
