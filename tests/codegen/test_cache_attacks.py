"""Another user who shares the machine plants kernels: by links, by being quicker, by names. None is loaded."""

import os

import pytest

from symid.codegen import CodegenWarning, build, cache as kept


def source(k: int) -> str:
    return f"int answer(void) {{ return {k}; }}"


@pytest.fixture(autouse=True)
def no_spare(monkeypatch):
    monkeypatch.setattr(kept, "_spare", [])


def planted(folder, name: str) -> None:
    """A library that answers 666, sealed as that of `name`, which an attacker can compute."""
    folder.mkdir(mode=0o700, exist_ok=True)
    evil = build._compile(source(666), build.compiler(), (), 60.0)
    (folder / f"{name}.so").write_bytes(evil + kept._seal(name, evil))


def test_a_link_that_is_turned_between_the_look_and_the_load(tmp_path, monkeypatch):
    mine, theirs, link = tmp_path / "mine", tmp_path / "theirs", tmp_path / "link"
    mine.mkdir(mode=0o700)
    link.symlink_to(mine)
    monkeypatch.setenv("SYMID_CACHE_DIR", str(link))
    planted(theirs, build.compiled(source(1)).stem)
    look = kept._content

    def turned(path, key):
        found = look(path, key)
        link.unlink()
        link.symlink_to(theirs)
        return found

    monkeypatch.setattr(kept, "_content", turned)
    assert build.load_library(source(1)).answer() == 1


@pytest.mark.parametrize("mode", [0o777, 0o770, 0o707, 0o1777])
def test_a_folder_that_another_user_made_just_before(tmp_path, monkeypatch, mode):
    folder = tmp_path / "cache"
    monkeypatch.setenv("SYMID_CACHE_DIR", str(folder))
    make = kept._make

    def quicker(place):
        os.mkdir(folder)
        os.chmod(folder, mode)
        make(place)

    monkeypatch.setattr(kept, "_make", quicker)
    with pytest.warns(CodegenWarning, match="other users can write to"):
        assert build.load_library(source(2)).answer() == 2
    assert not list(folder.iterdir())


def test_folders_above_are_made_for_this_user_alone(tmp_path, monkeypatch):
    monkeypatch.setenv("SYMID_CACHE_DIR", str(tmp_path / "a" / "b" / "c"))
    before = os.umask(0)
    try:
        assert build.load_library(source(3)).answer() == 3
    finally:
        os.umask(before)
    assert all((tmp_path / p).stat().st_mode & 0o777 == 0o700 for p in ("a", "a/b", "a/b/c"))


@pytest.mark.skipif(os.name != "posix" or os.geteuid() != 0, reason="only root can give files away")
def test_a_file_of_another_user_in_a_folder_of_this_one(tmp_path, monkeypatch):
    """By a link, hard or soft, or by a program that unpacks as root."""
    monkeypatch.setenv("SYMID_CACHE_DIR", str(tmp_path / "mine"))
    library = build.compiled(source(4))
    planted(tmp_path / "theirs", library.stem)
    evil = tmp_path / "theirs" / library.name
    os.chown(evil, 12345, 12345)
    for put in (lambda: os.link(evil, library), lambda: os.symlink(evil, library)):
        library.unlink()
        put()
        assert build.load_library(source(4)).answer() == 4
