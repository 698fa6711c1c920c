"""What results are written over, and what not."""

import os
import stat

import pytest
from courant import files
from courant.files import OutputError, note_input, open_for_writing, write_by, write_file


def test_links_are_neither_followed_nor_replaced(tmp_path):
    mine, link = tmp_path / "mine", tmp_path / "link"
    mine.write_text("mine")
    link.symlink_to("mine")
    for write in (lambda: write_file(link, "text"), lambda: write_file(link, "text", named=True), lambda: open_for_writing(link),
                  lambda: write_by(lambda made: made.write_text("text"), link)):
        with pytest.raises(OutputError, match="link': it is a link"):
            write()
    assert link.is_symlink() and mine.read_text() == "mine"


def test_devices_and_pipes_stay(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    for write in (lambda: write_file(pipe, "text"), lambda: open_for_writing(pipe, keep=True)):
        with pytest.raises(OutputError, match="it is no file"):
            write()
    with pytest.raises(OutputError):  # without a reader: it does not wait
        write_file(pipe, "text", named=True)
    reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    write_file(pipe, "text", named=True)
    assert os.read(reader, 8) == b"text"
    os.close(reader)
    link = tmp_path / "null"
    link.symlink_to("/dev/null")
    write_file(link, "text", named=True)
    assert stat.S_ISFIFO(pipe.stat().st_mode) and link.is_symlink()


def test_nothing_is_written_over_an_input(tmp_path, monkeypatch):
    monkeypatch.setattr(files, "_inputs", {})
    recipe = tmp_path / "results.yaml"
    recipe.write_text("mine")
    note_input(recipe)
    with pytest.raises(OutputError, match="it is the input"):
        write_file(recipe, "text")
    (tmp_path / "other").hardlink_to(recipe)
    with pytest.raises(OutputError, match="it is the input"):
        write_file(tmp_path / "other", "text", named=True)
    assert recipe.read_text() == "mine"
    recipe.unlink()  # a new file may get the number of one that is removed
    write_file(tmp_path / "other", "text", named=True)


def test_what_is_beside_a_named_file_stays(tmp_path):
    for name in ("page.md.tmp", f"page.md.{os.getpid()}.tmp"):
        (tmp_path / name).write_text("mine")
    write_file(tmp_path / "other.md", "text", named=True)
    with pytest.raises(OutputError):  # rather no page than a lost file
        write_file(tmp_path / "page.md", "text", named=True)
    assert [(tmp_path / name).read_text() for name in ("page.md.tmp", f"page.md.{os.getpid()}.tmp", "other.md")] == ["mine", "mine", "text"]
    assert len(list(tmp_path.iterdir())) == 3
