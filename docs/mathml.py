"""Formulas as MathML when the pages are built, so that they need no script and no network to be read."""

import re
from html import unescape

from latex2mathml.converter import convert

_FORMULA = re.compile(r'<(span|div) class="arithmatex">\\([(\[])(.*?)\\[)\]]</\1>', re.S)


def on_page_content(html: str, **_) -> str:
    """Called by MkDocs for each page: every formula that arithmatex marked becomes MathML."""

    def mathml(found: re.Match) -> str:
        tag, opening, formula = found.groups()
        if opening == "[":  # on a phone a long line is moved aside, not the page
            return f'<{tag} style="overflow-x: auto">{convert(unescape(formula), display="block")}</{tag}>'
        return f"<{tag}>{convert(unescape(formula), display='inline')}</{tag}>"

    return _FORMULA.sub(mathml, html)
