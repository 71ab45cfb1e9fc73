"""Give this Python a working cyipopt, without root and without conda.

Run as ``python -m symid.setup_ipopt`` (``make test`` and ``make demo`` do). cyipopt has no
wheels and needs an Ipopt to build against. The casadi wheel carries one, with MUMPS, METIS
and the headers; only its pkg-config file names a folder of the machine that made the wheel.
So: write a corrected ``ipopt.pc`` to a temporary folder and build cyipopt against that,
with the casadi folder as run-time library path. Where cyipopt works already (conda-forge)
nothing is built. Imports the standard library alone, because it runs before anything else.
"""

import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

PKG_CONFIG_FILE = """\
Name: ipopt
Description: Ipopt as shipped in the casadi wheel
Version: {version}
Cflags: -I{casadi}/include/coin-or
Libs: -L{casadi} -lipopt
"""


def cyipopt_works() -> bool:
    """Tell whether a fresh interpreter of this kind can import cyipopt and its Ipopt."""
    return subprocess.run([sys.executable, "-c", "import cyipopt"], capture_output=True).returncode == 0


def pip_install(*arguments: str, **environment: str) -> None:
    """Run ``pip install`` for this interpreter; leave the program with pip's error if it fails."""
    command = [sys.executable, "-m", "pip", "install", "--quiet", *arguments]
    if subprocess.run(command, env=os.environ | environment).returncode != 0:
        sys.exit(
            f"symid set-up: `{' '.join(command[1:])}` failed, see pip's message above. "
            "A C and C++ compiler and access to a Python package index are needed; "
            "with conda, `conda install -c conda-forge cyipopt` needs neither."
        )


def casadi_folder() -> Path:
    """Find the folder of the installed casadi package, which holds libipopt and its headers."""
    found = importlib.util.find_spec("casadi")
    folder = Path(found.submodule_search_locations[0]) if found else None
    if folder is None or not (folder / "include/coin-or/IpStdCInterface.h").exists():
        sys.exit(
            f"symid set-up: no Ipopt headers in the casadi package ({folder}). "
            "Install Ipopt >= 3.14 with its pkg-config file, or use conda-forge's cyipopt."
        )
    return folder


def ipopt_version(casadi: Path) -> str:
    """Read the Ipopt version from the pkg-config file that casadi ships."""
    lines = (casadi / "pkgconfig/ipopt.pc").read_text().splitlines()
    return next(line.split(":")[1].strip() for line in lines if line.startswith("Version:"))


def link_pkg_config(folder: Path) -> None:
    """Put a ``pkg-config`` from PyPI into `folder` where the system has none."""
    if shutil.which("pkg-config"):
        return
    pip_install("pkgconf")
    importlib.invalidate_caches()
    # The binary itself: the package's own script does not work inside pip's isolated build.
    (folder / "pkg-config").symlink_to(importlib.import_module("pkgconf").get_executable())


def build_cyipopt() -> None:
    """Install casadi and build cyipopt against the Ipopt in it."""
    pip_install("casadi")
    importlib.invalidate_caches()
    casadi = casadi_folder()
    with tempfile.TemporaryDirectory() as folder:
        link_pkg_config(Path(folder))
        description = PKG_CONFIG_FILE.format(version=ipopt_version(casadi), casadi=casadi)
        Path(folder, "ipopt.pc").write_text(description)
        # No cache: a cached wheel would carry the library path of another environment.
        pip_install(
            "--no-cache-dir",
            "--no-binary",
            "cyipopt",
            "cyipopt",
            PKG_CONFIG_PATH=folder,
            LDFLAGS=f"{os.environ.get('LDFLAGS', '')} -Wl,-rpath,{casadi}",
            PATH=f"{folder}{os.pathsep}{os.environ['PATH']}",
        )


def main() -> None:
    """Make sure that cyipopt works; build it once if it does not."""
    if cyipopt_works():
        print("symid set-up: cyipopt works, nothing to build")
        return
    print("symid set-up: building cyipopt against the Ipopt in the casadi wheel", flush=True)
    build_cyipopt()
    if not cyipopt_works():
        sys.exit(
            "symid set-up: cyipopt was built but cannot be imported. "
            f"Run `{sys.executable} -c 'import cyipopt'` to see why."
        )
    print("symid set-up: cyipopt is ready")


if __name__ == "__main__":
    main()
