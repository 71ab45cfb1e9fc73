"""The LaTeX of a part's symbol: letters and their marks, nothing that a browser would do more with than print it."""

from __future__ import annotations

import re

LONGEST = 200
"""Characters of one symbol; equations hold it many times."""
GREEK = (
    "alpha beta gamma delta epsilon varepsilon zeta eta theta vartheta iota kappa lambda mu nu xi pi varpi rho varrho "
    "sigma varsigma tau upsilon phi varphi chi psi omega Gamma Delta Theta Lambda Xi Pi Sigma Upsilon Phi Psi Omega"
)
MARKS = "bar hat tilde vec dot ddot overline underline widehat widetilde acute grave breve check"
FONTS = "mathrm mathbf mathit mathsf mathtt mathcal mathbb mathfrak boldsymbol text textrm textbf textit"
SIGNS = "ell hbar partial nabla infty prime ast star circ dagger perp parallel pm mp cdot times quad"
KNOWN = frozenset(" ".join((GREEK, MARKS, FONTS, SIGNS)).split())
_TOKEN = re.compile(r"\\([A-Za-z]+)|\\[,;:! ]|[\w ,'()+*/=.|-]|[{}_^]")


def why_no_letters(latex: str) -> str:
    """What keeps `latex` from being the symbol of a part, in words; empty where nothing does.

    Commands that lead to an address, set a style or define others are among what is not known: a notebook would obey.
    """
    if len(latex) > LONGEST:
        return f"it has {len(latex)} characters, at most {LONGEST} are printed"
    depth = place = 0
    while place < len(latex):
        token = _TOKEN.match(latex, place)
        if token is None:
            return f"{latex[place : place + 1]!r} cannot stand in it"
        if token[1] and token[1] not in KNOWN:
            return f"\\{token[1][:20]} is not one of the letters, marks and fonts that are known"
        depth += {"{": 1, "}": -1}.get(token[0], 0)
        if depth < 0:
            break
        place = token.end()
    if depth:
        return "its braces do not match"
    if re.search(r"[_^]\s*($|[}_^])", latex) or re.match(r"\s*[_^]", latex):
        return "_ and ^ stand between what they join"
    return ""
