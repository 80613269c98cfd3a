"""Files are there whole or not at all."""

import errno
import os
import stat
from pathlib import Path

import pytest

from derive import files
from derive.files import replacing, write_all, write_atomically

OLD, NEW = b"the one before", b"the new one"


def contents(folder: Path) -> dict[str, bytes]:
    files = (entry for entry in folder.rglob("*") if entry.is_file())
    return {str(file.relative_to(folder)): file.read_bytes() for file in files}


@pytest.mark.parametrize("content", ["u_c = 1e-3 µm\n", b"\x00\xff", "", "a\r\nb\n"])
def test_content_is_written_as_it_is(tmp_path, content):
    write_atomically(tmp_path / "wear.csv", content)
    expected = content.encode() if isinstance(content, str) else content
    assert contents(tmp_path) == {"wear.csv": expected}


def test_a_name_may_be_as_long_as_the_file_system_allows(tmp_path):
    write_atomically(tmp_path / f"{'a' * 251}.csv", "cycle\n")
    assert contents(tmp_path) == {f"{'a' * 251}.csv": b"cycle\n"}


@pytest.mark.parametrize("fault", [RuntimeError, KeyboardInterrupt, SystemExit, MemoryError])
def test_what_stops_a_writer_leaves_the_file_before_and_nothing_else(tmp_path, fault):
    target = tmp_path / "wear.nc"
    target.write_bytes(OLD)

    def write_half():
        with replacing(target) as draft:
            draft.write_bytes(NEW[:3])
            raise fault

    with pytest.raises(fault):
        write_half()
    assert contents(tmp_path) == {"wear.nc": OLD}


def test_the_file_before_is_there_until_the_new_one_is_whole(tmp_path):
    target = tmp_path / "wear.nc"
    target.write_bytes(OLD)
    with replacing(target) as draft:
        draft.write_bytes(NEW)
        assert target.read_bytes() == OLD
        assert draft.suffix == ".nc"
    assert contents(tmp_path) == {"wear.nc": NEW}


def test_a_file_keeps_its_permissions_and_a_new_one_follows_the_umask(tmp_path):
    old, new, plain = tmp_path / "old", tmp_path / "new", tmp_path / "plain"
    old.write_bytes(OLD)
    old.chmod(0o640)
    write_atomically(old, NEW)
    write_atomically(new, NEW)
    plain.write_bytes(NEW)
    assert stat.S_IMODE(old.stat().st_mode) == 0o640
    assert new.stat().st_mode == plain.stat().st_mode


def test_a_link_stays_a_link(tmp_path):
    target, link = tmp_path / "target", tmp_path / "link"
    target.write_bytes(OLD)
    link.symlink_to(target)
    write_atomically(link, NEW)
    assert link.is_symlink()
    assert target.read_bytes() == NEW


def test_a_device_is_written_to_and_not_replaced(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    write_atomically(pipe, NEW)
    assert os.read(reader, 100) == NEW
    os.close(reader)
    assert pipe.is_fifo()


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="/dev/full is Linux's")
def test_a_full_disk_is_reported_with_the_name_that_the_user_gave():
    with pytest.raises(OSError, match="No space left") as caught:
        write_atomically("/dev/full", NEW)
    assert (caught.value.errno, caught.value.filename) == (errno.ENOSPC, "/dev/full")


@pytest.mark.parametrize("name", ["missing/wear.csv", "file/wear.csv", "folder"])
def test_a_place_that_cannot_be_written_is_reported_by_its_own_name(tmp_path, name):
    (tmp_path / "file").write_bytes(OLD)
    (tmp_path / "folder").mkdir()
    with pytest.raises(OSError, match=r".") as caught:
        write_atomically(tmp_path / name, NEW)
    assert caught.value.filename == str(tmp_path / name)
    assert contents(tmp_path) == {"file": OLD}


def test_a_folder_receives_its_files_and_keeps_others(tmp_path):
    (tmp_path / "report.html").write_bytes(OLD)
    (tmp_path / "own.txt").write_bytes(OLD)
    write_all(tmp_path, {"report.html": NEW, "2a.svg": "<svg/>"})
    assert contents(tmp_path) == {"report.html": NEW, "own.txt": OLD, "2a.svg": b"<svg/>"}


@pytest.mark.parametrize("fault", [RuntimeError, KeyboardInterrupt])
def test_what_stops_the_writers_leaves_a_folder_as_it_was(tmp_path, monkeypatch, fault):
    new, old = tmp_path / "deep" / "new", tmp_path / "old"
    old.mkdir()
    (old / "report.html").write_bytes(OLD)

    def stopped(path, content):
        if path.name == "2a.svg":
            raise fault
        write_atomically(path, content)

    monkeypatch.setattr(files, "write_atomically", stopped)
    for folder in (new, old):
        with pytest.raises(fault):
            write_all(folder, {"report.html": NEW, "2a.svg": NEW})
    assert not new.exists()
    assert contents(tmp_path) == {"old/report.html": OLD}


def test_a_file_in_place_of_a_folder_is_reported(tmp_path):
    (tmp_path / "report").write_bytes(OLD)
    with pytest.raises(OSError, match="exists") as caught:
        write_all(tmp_path / "report", {"report.html": NEW})
    assert caught.value.filename == str(tmp_path / "report")
