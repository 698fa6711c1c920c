"""history.h5: values, dimensions, gaps and damage."""

from __future__ import annotations

import numpy as np
from courant.diagnostics import Diagnostics
from courant.histories import HistoryFile
from made_runs import write_history


def made(folder):
    t = np.arange(6.0)
    force = np.column_stack([t, -1 - t, 0 * t])
    force[3:] = np.nan  # silent from there on, as after a restart
    write_history(
        folder,
        {
            "global/time": (t, "T"),
            "global/kinetic": (3 + t, "ML2/T2"),
            "contacts/7/force": (force, "ML/T2"),
            "contacts/7/late": (t[:2], "-"),
        },
    )


def test_columns_and_dimensions(tmp_path):
    made(tmp_path)
    file = HistoryFile.open(tmp_path / "history.h5", Diagnostics())
    assert file.names == ["/contacts/7/force", "/contacts/7/late", "/global/kinetic", "/global/time"]
    assert file.components("/contacts/7/force") == 3 and file.components("/nothing") == 0
    assert file.dimension("/contacts/7/force") == "ML/T2" and file.dimension("/nothing") == "-"
    assert np.array_equal(file.column("/global/kinetic"), np.arange(3.0, 9.0))
    assert np.array_equal(file.column("/contacts/7/force", 1)[:3], [-1, -2, -3]) and np.isnan(file.column("/contacts/7/force", 1)[3:]).all()
    assert file.column("/contacts/7/force", 3) is None and file.column("/nothing") is None
    assert np.isnan(file.column("/contacts/7/late")[2:]).all()
    assert file.sampled("/contacts/7/force").tolist() == [True, True, True, False, False, False]


def test_missing_foreign_and_damaged_files(tmp_path):
    made(tmp_path)
    path = tmp_path / "history.h5"
    whole, random = path.read_bytes(), np.random.default_rng(3)

    def message(content: bytes) -> str:
        path.write_bytes(content)
        diagnostics = Diagnostics()
        assert HistoryFile.open(path, diagnostics) is None
        return diagnostics.text()

    for _ in range(200):
        content = bytearray(whole)
        at = random.integers(0, len(content))
        content[at] ^= 1 << random.integers(0, 8)
        if bytes(content) != whole:
            assert "its checksum is not that of its content" in message(bytes(content)), at
    assert "checksum" in message(whole[:-9]) and "checksum" in message(b"")
    diagnostics = Diagnostics()
    assert HistoryFile.open(tmp_path / "no.h5", diagnostics) is None
    assert "no histories here: the file is missing" in diagnostics.text()


def test_a_file_without_times(tmp_path):
    write_history(tmp_path, {"global/kinetic": (np.ones(3), "ML2/T2")})
    diagnostics = Diagnostics()
    assert HistoryFile.open(tmp_path / "history.h5", diagnostics) is None
    assert "not a history file of `courant run`\n" in diagnostics.text()
