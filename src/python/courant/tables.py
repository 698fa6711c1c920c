"""Tables whose columns have units."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from .files import write_figure
from .optional import module


@dataclass
class Column:
    """`name` without blanks or commas; `unit` "-": no dimension; `values`: (rows,), NaN: there is none."""

    name: str
    unit: str
    values: np.ndarray

    def __post_init__(self) -> None:
        self.values = np.asarray(self.values, dtype=float)


@dataclass
class Table:
    """Columns of the same length. `name`: of the file, without its ending."""

    name: str
    columns: list[Column] = field(default_factory=list)

    def add(self, name: str, unit: str, values: Iterable[float] | np.ndarray) -> None:
        self.columns.append(Column(name, unit, np.asarray(values, dtype=float)))

    def find(self, name: str) -> Column | None:
        return next((column for column in self.columns if column.name == name), None)

    @property
    def rows(self) -> int:
        return len(self.columns[0].values) if self.columns else 0

    def csv(self) -> str:
        """Head "name [unit],..." and one line per row; NaN is "nan". Nine digits."""
        head = ",".join(f"{column.name} [{column.unit}]" for column in self.columns) + "\n"
        if not self.columns:
            return head
        line = ",".join(["%.9g"] * len(self.columns)) + "\n"
        return head + "".join([line % row for row in zip(*(column.values.tolist() for column in self.columns), strict=True)])

    def __getitem__(self, name: str) -> np.ndarray:
        """The values of a column, (rows,). Raises KeyError with the names that there are."""
        column = self.find(name)
        if column is None:
            raise KeyError(f"'{self.name}' has no column '{name}'; it has {', '.join(self.names)}")
        return column.values

    def __len__(self) -> int:
        return self.rows

    def __contains__(self, name: object) -> bool:
        return name in self.names

    def __iter__(self) -> Iterator[str]:
        """Names of the columns, as of a pandas.DataFrame."""
        return iter(self.names)

    def keys(self) -> list[str]:
        """Names of the columns: `dict(table)` has their values."""
        return self.names

    def __repr__(self) -> str:
        return f"<Table {self.name}: {self.rows} rows of {', '.join(f'{one.name} [{one.unit}]' for one in self.columns)}>"

    @property
    def names(self) -> list[str]:
        return [column.name for column in self.columns]

    @property
    def units(self) -> dict[str, str]:
        return {column.name: column.unit for column in self.columns}

    def to_pandas(self) -> Any:
        """A pandas.DataFrame whose index is the first column, with the units in attrs["units"]. Raises MissingModule."""
        columns = {column.name: column.values for column in self.columns}
        frame = module("pandas").DataFrame(columns)
        frame.attrs["units"] = self.units
        return frame.set_index(self.names[0]) if self.columns else frame

    def to_xarray(self) -> Any:
        """An xarray.Dataset whose coordinate is the first column; each variable has its unit in attrs["units"]. Raises MissingModule."""
        first, *others = self.columns
        coordinates = {first.name: (first.name, first.values, {"units": first.unit})}
        variables = {one.name: (first.name, one.values, {"units": one.unit}) for one in others}
        return module("xarray").Dataset(variables, coordinates)

    def plot(self, *names: str, file: str | Path | None = None) -> Any:
        """Columns over the first one, all of them if none is named; one pair of axes for each unit. Gives matplotlib's figure, and writes
        it to `file`. Raises MissingModule."""
        from .style import pyplot

        first, chosen = self.columns[0], [one for one in self.columns[1:] if not names or one.name in names]
        if names and len(chosen) < len(names):
            self[next(name for name in names if self.find(name) is None)]
        units = list(dict.fromkeys(one.unit for one in chosen))
        rows = max(1, len(units))
        figure, panels = pyplot().subplots(rows, 1, figsize=(7.2, 1.0 + 3.0 * rows), sharex=True, squeeze=False, constrained_layout=True)
        for axes, unit in zip(panels[:, 0], units, strict=False):
            for one in chosen:
                if one.unit == unit:
                    axes.plot(first.values, one.values, label=one.name, linewidth=1.3)
            axes.set_ylabel(f"[{unit}]")
            axes.grid(True)
            axes.legend()
        panels[0, 0].set_title(self.name)
        panels[-1, 0].set_xlabel(f"{first.name} [{first.unit}]")
        if file is not None:
            write_figure(figure, Path(file), named=True)
        return figure


def table_of(name: str, columns: Sequence[tuple[str, str, np.ndarray]]) -> Table:
    """A table of (name, unit, values)."""
    return Table(name, [Column(*column) for column in columns])
