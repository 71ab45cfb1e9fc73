"""Public recordings that are not shipped: fetched when asked for, checked, and kept.

The article's recording (Wang & van den Bogert 2020: subject 5, trial 3, 310 s) stands in the repository of the first
author's dissertation (archived as Zenodo record 3767611), at one pinned commit, as text files without headers. What is
made of them is compared with a checksum. The measured data of all eight subjects are Zenodo record 3819630; it states a
checksum for each file, and what was downloaded first is written down beside it.
"""

from __future__ import annotations

import hashlib
import json
import os
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from symid.errors import RecordingError
from symid.files import read_json, write_atomically, write_json
from symid.progress import say

FOLDER_VARIABLE = "SYMID_STANDING"
"""Environment variable that names a folder with the article's recording, or where it is to be put."""
COMMIT = "517b3bc262805ebf1a89735181422dafc4948732"
SOURCE = f"https://raw.githubusercontent.com/Huawei-ClevelandStateUniv/Dissertation_Work/{COMMIT}/Chapter4/experimental_data/"
ANGLES, SWAY, BODY = "Subj05/JointsGF0003.txt", "Subj05/Sway0003.txt", "Para_Winter_Subj05.txt"
PAGE = "https://zenodo.org/records/3767611"
RECORD = "https://zenodo.org/api/records/3819630"
RECORD_PAGE = "https://zenodo.org/records/3819630"
RECORDINGS = ("recording_100hz.csv", "recording_50hz.csv", "body.json")
SHA256 = "cb5136b4d24d530b82ae7a6d38500f2de6da95965c615c35ffaabadec49a32fa"
"""Of recording_100hz.csv, which holds every number of the two files that were measured, to nine digits."""
BODY_SHA256 = "c3127b580625e938ecfe72b3b19323db3f6e1a053faf73da70cadb9acc9d1239"
"""Of body.json as it is made."""
HEADER = (
    "time_s,ankle_angle_deg,hip_angle_deg,ankle_velocity_deg_s,hip_velocity_deg_s,"
    "platform_position_m,platform_velocity_m_s,platform_acceleration_m_s2"
)
BODY_KEYS = (
    "leg_length_m",
    "leg_com_m",
    "trunk_com_m",
    "leg_mass_kg",
    "trunk_mass_kg",
    "leg_inertia_kg_m2",
    "trunk_inertia_kg_m2",
)
LOCK = "checksums.json"
CONNECT_S = 30.0


def standing(folder: str | Path | None = None) -> Path:
    """Folder with the article's recording: `recording_100hz.csv`, `recording_50hz.csv` and `body.json`.

    Parameters
    ----------
    folder : where it is, or is to be put; by default what the environment variable ``SYMID_STANDING`` names, or a
        folder of this user's cache.

    Raises
    ------
    RecordingError
        The files are not there and cannot be downloaded, or are others than those of the article.

    Examples
    --------
    >>> folder = standing()                                        # doctest: +SKIP
    >>> rec = si.read_recording(folder / "recording_50hz.csv")     # doctest: +SKIP
    """
    place = Path(folder or os.environ.get(FOLDER_VARIABLE) or _cache() / "standing_subject05")
    if not all((place / name).is_file() for name in RECORDINGS):
        _writable(place)
        there = {name: _found(place, name) for name in (ANGLES, SWAY, BODY)}
        files = {name: path or _downloaded(SOURCE + name, place) for name, path in there.items()}
        try:
            made = prepared(files[ANGLES], files[SWAY], files[BODY])
            for name, right in ((RECORDINGS[0], SHA256), (RECORDINGS[2], BODY_SHA256)):
                if hashlib.sha256(made[name].encode()).hexdigest() != right:
                    raise RecordingError(f"{place}: what the authors' files hold is not the article's {name} (SHA-256)")
        except RecordingError as problem:
            for name, path in there.items():
                if path is None:
                    files[name].unlink(missing_ok=True)
            kept = ", ".join(str(path) for path in there.values() if path is not None)
            cure = f"remove {kept}, and fetch again" if kept else "what was downloaded is removed; fetch again"
            raise RecordingError(f"{problem}; {cure}") from None
        for name, content in made.items():
            write_atomically(place / name, content)
    _compare(place)
    return place


def _writable(place: Path) -> None:
    """RecordingError where nothing can be put into a folder; made if it is not there."""
    try:
        place.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=place):
            pass
    except OSError as problem:
        raise RecordingError(
            f"{place}: cannot be written to ({problem.strerror}); name another folder with --folder or "
            f"{FOLDER_VARIABLE}"
        ) from None


def prepared(angles: Path, sway: Path, body: Path) -> dict[str, str]:
    """Recordings and body file, name -> content, from the authors' text files.

    Parameters
    ----------
    angles : rows of time [s], ankle and hip angle [deg] and their rates [deg/s] at 100 Hz.
    sway : rows of time [s], platform position [m], velocity [m/s] and acceleration [m/s^2].
    body : seven numbers [m, kg, kg m^2] in the order of `BODY_KEYS`.
    """
    joints, platform = _numbers(angles, 5), _numbers(sway, 4)
    n = min(len(joints), len(platform))
    full = np.hstack([joints[:n], platform[:n, 1:]])
    values = dict(zip(BODY_KEYS, map(float, _numbers(body, 7)[0]), strict=True)) | {"gravity_m_s2": 9.81}
    return {
        RECORDINGS[0]: _table(full),
        RECORDINGS[1]: _table(_thinned(full)),
        RECORDINGS[2]: json.dumps(values, indent=1),
    }


def _thinned(full: np.ndarray) -> np.ndarray:
    """Every second row, with the rates and accelerations of the thinned signals, none at the ends."""
    half = full[::2].copy()
    step = half[1, 0] - half[0, 0]
    for rate, of in ((3, 1), (4, 2), (6, 5), (7, 6)):
        half[:, rate] = 0.0
        half[1:-1, rate] = (half[2:, of] - half[:-2, of]) / (2 * step)
    return half


def _table(rows: np.ndarray) -> str:
    return "\n".join([HEADER, *(",".join(f"{x:.9g}" for x in row) for row in rows)]) + "\n"


def _numbers(path: Path, columns: int) -> np.ndarray:
    try:
        rows = np.loadtxt(path, ndmin=2)
    except (ValueError, OSError) as problem:
        raise RecordingError(f"{path}: is no table of numbers: {str(problem).rstrip('.')}") from None
    if rows.shape[1] != columns:
        raise RecordingError(f"{path}: has {rows.shape[1]} columns; {columns} are needed")
    return rows


def _compare(place: Path) -> None:
    """RecordingError where a file is not the article's; of the 50 Hz only the rates may differ, in their last digit."""
    full, half, body = (place / name for name in RECORDINGS)
    other = next((path for path, right in ((full, SHA256), (body, BODY_SHA256)) if _sha256(path) != right), None)
    if other is None and not _thinned_from(full, half):
        other = half
    if other is not None:
        raise RecordingError(
            f"{other}: is not the article's recording (its content differs); remove {', '.join(RECORDINGS)} "
            f"from {place} to make them anew"
        )


def _thinned_from(full: Path, half: Path) -> bool:
    try:
        right, found = (np.loadtxt(path, delimiter=",", skiprows=1) for path in (full, half))
    except ValueError:
        return False
    right = _thinned(right)
    return right.shape == found.shape and np.allclose(found, right, rtol=1e-6, atol=3e-7)  # nine digits are written


def _found(place: Path, name: str) -> Path | None:
    """A file that somebody has put into the folder, at whatever depth: an unpacked archive will do."""
    return next(iter(sorted(place.rglob(Path(name).name))), None) if place.is_dir() else None


def _downloaded(url: str, place: Path) -> Path:
    import pooch

    name = url.rsplit("/", 1)[-1]
    say(f"fetching {url}")
    try:  # unchecked here: what is made of the files is compared with SHA256
        return Path(pooch.retrieve(url, None, fname=name, path=place, downloader=_downloader()))
    except Exception as problem:
        raise RecordingError(
            f"{name} cannot be downloaded ({_short(problem)}): download {ANGLES}, {SWAY} and {BODY} from "
            f"{SOURCE} (archived at "
            f"{PAGE}) with a browser, and put them into {place}, or name a folder that has them with "
            f"--folder or {FOLDER_VARIABLE}"
        ) from None


# ---- the measured data of all subjects ---------------------------------------------------------------
def standing_raw(folder: str | Path | None = None) -> Path:
    """Folder with all files of Zenodo record 3819630: markers, forces and EMG of eight subjects.

    Every file is compared with the checksum that the record states; its SHA-256 at the first download is written to
    ``checksums.json`` beside it, and compared ever after.

    Parameters
    ----------
    folder : where they are, or are to be put; a folder of this user's cache by default.

    Raises
    ------
    RecordingError
        The record or a file cannot be downloaded, or a file is not what was downloaded first.

    Examples
    --------
    >>> folder = standing_raw()                                    # doctest: +SKIP
    """
    place = Path(folder or _cache() / "standing_raw")
    _writable(place)
    locked = _locked(place / LOCK) if (place / LOCK).is_file() else {}
    for name, url, checksum in _listed(place) if not locked else ((k, "", "") for k in locked):
        path = place / name
        if url:  # one that is there already is compared with what the record states
            _retrieved(url, name, checksum, place)
        elif not path.is_file():
            raise RecordingError(f"{path}: is missing; remove {place / LOCK} to fetch the record anew")
        if locked.setdefault(name, _sha256(path)) != _sha256(path):
            raise RecordingError(
                f"{path}: is not what was downloaded first ({LOCK}); remove it and {LOCK} to fetch it anew"
            )
    write_json(place / LOCK, locked)
    return place


def _locked(path: Path) -> dict[str, str]:
    """Name -> SHA-256 of each file, all in the folder of `path`."""
    locked = read_json(path)
    if not isinstance(locked, dict) or not all(isinstance(v, str) and Path(k).name == k for k, v in locked.items()):
        raise RecordingError(f"{path}: is no list of files and their checksums; remove it to fetch the record anew")
    return locked


def _listed(place: Path) -> Iterator[tuple[str, str, str]]:
    """Name, address and stated checksum ("md5:...") of each file of the record."""
    import requests

    try:
        answer = requests.get(RECORD, timeout=CONNECT_S)
        answer.raise_for_status()
        files = [(f["key"], f["links"]["self"], f["checksum"]) for f in answer.json()["files"]]
    except (requests.RequestException, ValueError, KeyError, TypeError) as problem:
        raise RecordingError(_by_hand(place, problem)) from None
    yield from files


def _retrieved(url: str, name: str, checksum: str, place: Path) -> None:
    import pooch

    if Path(name).name != name:
        raise RecordingError(f"the record names a file {name!r}, which does not stay in its folder")
    say(f"fetching {name}")
    try:
        pooch.retrieve(url, checksum, fname=name, path=place, downloader=_downloader())
    except Exception as problem:
        raise RecordingError(_by_hand(place, problem)) from None


def _by_hand(place: Path, problem: Exception) -> str:
    return (
        f"Zenodo cannot be reached ({_short(problem)}): download the files of {RECORD_PAGE} with a "
        f"browser, and use them from "
        f"where you put them; symid looks for them in {place}"
    )


def _short(problem: Exception) -> str:
    return type(problem).__name__ if len(str(problem)) > 80 else str(problem)


def _downloader():
    import pooch

    pooch.get_logger().setLevel("ERROR")
    return pooch.HTTPDownloader(timeout=CONNECT_S)


def _cache() -> Path:
    import pooch

    return Path(pooch.os_cache("symid"))


def _sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()
