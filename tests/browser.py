"""A page as a browser shows it, on a desk and on a phone."""

import json
import re
import shutil
import subprocess
import tempfile
from html import unescape
from pathlib import Path

import pytest

WIDTHS = (1280, 390)
CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
needs_browser = pytest.mark.skipif(CHROMIUM is None, reason="no Chromium to open the page with")

# Frames as wide as the screens: a window of Chromium itself is never as narrow as a phone.
FRAMES = """<body>{frames}<p id="out"></p><script>
window.onload = () => {{
  const told = [...document.querySelectorAll("iframe")].map(f => {{
    const d = f.contentDocument, e = d.documentElement;
    d.querySelectorAll("details").forEach(x => x.open = true);
    const blank = i => {{
      const c = document.createElement("canvas"); c.width = 40; c.height = 40;
      const p = c.getContext("2d"); p.drawImage(i, 0, 0, 40, 40);
      const v = p.getImageData(0, 0, 40, 40).data;
      return v.every((x, k) => x === v[k % 4]);
    }};
    const wide = [...d.querySelectorAll("main > *, table, img")].filter(x => x.closest(".scroll") === null &&
      x.getBoundingClientRect().right > e.clientWidth + 1).map(x => x.tagName + " " + x.textContent.slice(0, 40));
    return {{overflow: e.scrollWidth - e.clientWidth, wide: wide,
            empty: [...d.images].filter(i => !i.naturalWidth || blank(i)).length, figures: d.images.length}};
  }});
  document.getElementById("out").textContent = JSON.stringify(told);
}};
</script></body>"""


def seen(page: Path) -> list[dict]:
    """For each of WIDTHS what is wider than the page, how many figures there are and how many are empty;
    "console" of both.
    """
    frames = "".join(f'<iframe src="{page.name}" style="width:{w}px;height:4000px"></iframe>' for w in WIDTHS)
    (page.parent / "frames.html").write_text(FRAMES.format(frames=frames))
    command = [CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", "--allow-file-access-from-files"]
    command += ["--enable-logging=stderr", "--virtual-time-budget=8000", "--dump-dom"]
    with tempfile.TemporaryDirectory() as own:  # the home may be one that cannot be written
        command += [f"--user-data-dir={own}", f"file://{page.parent}/frames.html"]
        done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    (page.parent / "frames.html").unlink()
    found = re.search(r'<p id="out">(.*?)</p>', done.stdout, re.S)
    assert found and found[1], done.stderr[-2000:]
    console = re.findall(r"CONSOLE.*", done.stderr)
    return [told | {"console": console} for told in json.loads(unescape(found[1]))]


def assert_well_shown(page: Path, figures: int) -> None:
    """No error on the console, nothing wider than the page, and as many figures as there should be, none empty."""
    for width, told in zip(WIDTHS, seen(page), strict=True):
        assert told == {"overflow": 0, "wide": [], "empty": 0, "figures": figures, "console": []}, width
