"""The cache of compiled kernels cannot be broken, nor can the compiler break symid."""

import errno
import os
import pickle
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import sympy as sm
from conftest import pendulum
from kernels import BACKENDS, NO_COMPILER, D, P, Q, X, Y, arguments, program

from symid.codegen import CodegenWarning, build, cache as kept, compile_program, kept as kept_module, load_library
from symid.codegen.kept import kept_source
from symid.codegen.ode import ode_source
from symid.errors import CodegenError

pytestmark = pytest.mark.usefixtures("empty_cache")


# ---- the cache and the compiler ------------------------------------------------------------
def only_library(folder):
    return next(iter(folder.glob("*.so")))


def test_the_second_use_compiles_nothing(tmp_path, monkeypatch):
    monkeypatch.setenv("SYMID_CACHE_DIR", str(tmp_path))
    compile_program(program(X * sm.cos(Y)), "c")
    monkeypatch.setattr(build, "_compile", None)
    k = compile_program(program(X * sm.cos(Y)), "c")
    assert set(k.seconds) == {"derive", "compile", "load"}


@pytest.mark.parametrize(
    "damage",
    [lambda b: b[:1000], lambda b: b"", lambda b: b"garbage" * 1000, lambda b: b[:3000] + b"\0" * 64 + b[3064:]],
)
def test_a_damaged_library_is_built_again(tmp_path, monkeypatch, damage):
    monkeypatch.setenv("SYMID_CACHE_DIR", str(tmp_path))
    source = "double twice(double x) { return 2 * x; }"
    good = build.compiled(source).read_bytes()
    build.compiled(source).write_bytes(damage(good))
    library = load_library(source)
    library.twice.restype, library.twice.argtypes = build.ctypes.c_double, [build.ctypes.c_double]
    assert library.twice(21.0) == 42.0


def in_a_new_process(code: str, **environment) -> subprocess.Popen:
    return subprocess.Popen(
        [sys.executable, "-c", code],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | environment,
    )


SMALL = """
import numpy as np, sympy as sm
from symid.codegen import Program, compile_program
x, p = sm.symbols("x p", real=True)
k = compile_program(Program("small", (sm.sin(x) * p,), (x,), (p,)))
print(k.backend, k.residual(np.ones((3, 1)), np.array([2.0]), np.zeros((3, 0)), np.zeros(0)).sum())
"""


def test_processes_that_build_the_same_kernel_at_once_do_not_disturb_each_other(tmp_path):
    processes = [in_a_new_process(SMALL, SYMID_CACHE_DIR=str(tmp_path)) for _ in range(4)]
    results = [p.communicate() for p in processes]
    assert results == [(f"c {6 * np.sin(1.0)}\n", "")] * 4
    assert [f.suffix for f in tmp_path.iterdir()] == [".so"]


def spared(monkeypatch) -> None:
    monkeypatch.setattr(kept, "_spare", [])


def test_a_cache_that_cannot_be_written_is_replaced_with_one_warning(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv("SYMID_CACHE_DIR", str(tmp_path / "file" / "cache"))
    spared(monkeypatch)
    with pytest.warns(CodegenWarning, match="cannot be kept in .*file/cache .*; set SYMID_CACHE_DIR") as caught:
        for row in (X * 3, X * 4, X * 3):
            k = compile_program(program(row), "c")
    assert len(caught) == 1
    assert np.allclose(k.residual(*arguments(k)), 3 * arguments(k)[0][:, :1])
    monkeypatch.setattr(build, "_compile", None)
    compile_program(program(X * 4), "c")  # from the temporary folder


def test_a_full_cache_is_replaced_and_nothing_half_written_stays(tmp_path, monkeypatch):
    monkeypatch.setenv("SYMID_CACHE_DIR", str(tmp_path))
    spared(monkeypatch)
    real = os.replace

    def full(source, target):
        if str(target).startswith(str(tmp_path)):
            raise OSError(errno.ENOSPC, "No space left on device")
        real(source, target)

    monkeypatch.setattr(os, "replace", full)
    with pytest.warns(CodegenWarning, match="No space left on device"):
        assert compile_program(program(X * 5), "c").backend == "c"
    assert list(tmp_path.iterdir()) == []


def test_a_kernel_under_the_name_of_another_is_built_again(tmp_path, monkeypatch):
    monkeypatch.setenv("SYMID_CACHE_DIR", str(tmp_path))
    sources = [f"int answer(void) {{ return {k}; }}" for k in (41, 42)]
    other, own = (build.compiled(source) for source in sources)
    own.write_bytes(other.read_bytes())
    assert load_library(sources[1]).answer() == 42


def test_the_cache_is_for_this_user_alone(tmp_path, monkeypatch):
    monkeypatch.setenv("SYMID_CACHE_DIR", str(tmp_path / "new" / "cache"))
    path = build.compiled("int one(void) { return 1; }")
    assert path.parent.stat().st_mode & 0o777 == 0o700
    path.chmod(0o777)
    assert kept.find(path.stem) is None  # others could have changed it


def test_a_folder_that_others_can_write_to_is_not_believed(tmp_path, monkeypatch):
    shared = tmp_path / "shared"
    monkeypatch.setenv("SYMID_CACHE_DIR", str(shared / "cache"))
    source = "int two(void) { return 2; }"
    path = build.compiled(source)
    for open_one in (shared, shared / "cache"):
        open_one.chmod(0o777)
        spared(monkeypatch)
        with pytest.warns(CodegenWarning, match=f"other users can write to {open_one}\\).*mode 0700"):
            assert build.compiled(source).parent != path.parent
        open_one.chmod(0o700)
    assert build.compiled(source) == path


def test_a_folder_of_another_user_is_said(tmp_path, monkeypatch):
    monkeypatch.setenv("SYMID_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(os, "geteuid", lambda: os.getuid() + 7)
    spared(monkeypatch)
    with pytest.warns(CodegenWarning, match="belongs to another user"):
        build.compiled("int three(void) { return 3; }")
    assert list(tmp_path.iterdir()) == []


def stand_in(folder, script: str) -> dict[str, str]:
    """An environment whose compiler is a shell script; $what is its target file."""
    path = folder / "cc"
    path.write_text(f"#!/bin/sh\n{script}\n")
    path.chmod(0o755)
    return {"CC": str(path)}


VERSION = 'case "$*" in *--version*) echo 1.0; exit 0;; esac\n'


@pytest.mark.parametrize(
    "environment, words",
    [
        (NO_COMPILER, "cannot be run"),
        ({"PATH": "/nowhere", "CC": ""}, "cannot be run"),
        ({"CC": "false"}, "--version' fails"),
        ({"CC": "cc 'unfinished"}, "is no command"),
        ({"CC": "true"}, "wrote nothing"),
        ({"CC": "/"}, "cannot be run"),
        (VERSION + "echo out of memory >&2; exit 1", "out of memory"),
        ("sleep 60", "did not end within 0.2 s"),
        (VERSION + "sleep 60 & wait", "did not end within 0.2 s"),
        (VERSION + 'echo "#$*" > /dev/null', "wrote nothing"),
    ],
)
def test_without_a_working_compiler_numpy_is_used_with_one_warning(tmp_path, monkeypatch, environment, words):
    for name, value in (stand_in(tmp_path, environment) if isinstance(environment, str) else environment).items():
        monkeypatch.setenv(name, value)
    monkeypatch.setattr(build, "_warned", [])
    monkeypatch.setattr(build, "PROBE_S", 0.2 if "0.2" in words else 10.0)
    build._identity.cache_clear()
    build._probe.cache_clear()
    with pytest.warns(CodegenWarning, match=f"run in NumPy, .* slower than C: (.|\n)*{words}") as caught:
        kernels = [compile_program(program(row)) for row in (X, Y)]
    assert [k.backend for k in kernels] == ["numpy", "numpy"] and len(caught) == 1
    with pytest.raises(CodegenError, match=words):
        compile_program(program(X), "c")
    build._identity.cache_clear()
    build._probe.cache_clear()


def test_a_source_that_the_compiler_rejects_is_an_error_with_its_words():
    with pytest.raises(CodegenError, match="the C compiler cc failed:(.|\n)*error"):
        load_library("this is not C")


def test_a_compiler_that_knows_no_special_flags_still_works(tmp_path, monkeypatch):
    """A stand-in that refuses whatever an old or foreign compiler may not know."""
    script = tmp_path / "oldcc"
    script.write_text(
        f'#!/bin/sh\ncase "$*" in *march*|*mvec*|*openmp*) exit 1;; esac\nexec {shutil.which("cc")} "$@"\n'
    )
    script.chmod(0o755)
    p = program(sm.sin(X) * sm.exp(P) + D)
    good = compile_program(p, "c")
    monkeypatch.setenv("CC", str(script))
    plain = compile_program(p, "c")
    assert np.allclose(plain.residual(*arguments(plain)), good.residual(*arguments(good)), rtol=1e-14)


@pytest.mark.parametrize("backend", BACKENDS)
def test_a_pickled_kernel_works_in_another_process(tmp_path, backend):
    k = compile_program(program(sm.sin(X) * P + D, Y * Q), backend)
    args = arguments(k)
    (tmp_path / "job").write_bytes(pickle.dumps((k, args)))
    job = str(tmp_path / "job")
    code = f"import pickle; k, a = pickle.load(open({job!r}, 'rb')); print(k.backend, k.residual(*a).sum())"
    assert in_a_new_process(code).communicate() == (f"{backend} {k.residual(*args).sum()}\n", "")


def test_the_source_is_the_same_in_every_process():
    code = """
import sympy as sm
from symid.codegen.source import generate
from symid.codegen import Program
x, y, p, q = sm.symbols("x y p q", real=True)
rows = (sm.Max(x, y, p, q) * sm.Min(p, x * y), sm.Piecewise((x * y + q, sm.And(x > p, y > q, p > 0)),
        (sm.sin(x + y + p + q), sm.Or(x < 1, y < 2, p < 3)), (x * y * p * q, True)), (x + y * p + q) ** 3 / (x * q + y))
print(generate(Program("any", rows, (x, y), (p, q))).text)
"""
    processes = [in_a_new_process(code, PYTHONHASHSEED=str(seed)) for seed in range(1, 5)]
    assert len({p.communicate() for p in processes}) == 1


# ---- sources of simulations ----------------------------------------------------------------
@pytest.fixture
def sources(tmp_path, monkeypatch) -> tuple[Path, Path]:
    """Two kept sources: of a pendulum, and of one whose stiffness acts the other way."""
    monkeypatch.setenv("SYMID_CACHE_DIR", str(tmp_path))
    model, other = pendulum(), pendulum()
    other.substitute({other.stiffness.symbol: -other.stiffness.symbol})
    texts = [kept_source(m).text for m in (model, other)]
    one, two = (tmp_path / f"{kept_module._key(m)}.json" for m in (model, other))
    assert one.exists() and two.exists() and texts[0] != texts[1]
    return one, two


@pytest.mark.parametrize(
    "damage",
    [
        lambda one, other: one.write_bytes(one.read_bytes().replace(b"sin", b"cos", 1)),
        lambda one, other: one.write_bytes(one.read_bytes()[:2000]),
        lambda one, other: one.write_bytes(one.read_bytes()[:-32]),
        lambda one, other: one.write_bytes(other.read_bytes()),
        lambda one, other: one.write_text("{}"),
        lambda one, other: one.unlink() or one.mkdir(),
        lambda one, other: one.chmod(0o666),
    ],
    ids=["a function exchanged", "cut", "no seal", "another's", "an empty table", "a folder", "others can write"],
)
def test_a_damaged_source_of_a_simulation_is_derived_again(sources, damage, monkeypatch):
    whole = kept_source(pendulum()).text
    damage(*sources)
    derived = []
    monkeypatch.setattr(kept_module, "ode_source", lambda model: derived.append(model) or ode_source(model))
    assert kept_source(pendulum()).text == whole and len(derived) == 1


def test_a_kept_source_is_not_derived_again(sources, monkeypatch):
    monkeypatch.setattr(kept_module, "ode_source", lambda model: pytest.fail("derived again"))
    assert kept_source(pendulum()).text
