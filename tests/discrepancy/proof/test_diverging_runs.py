"""What is said of a free run that diverges in the held-out window."""

from types import SimpleNamespace

import numpy as np
import pytest

from symid.discrepancy.prove.held_out import Proof
from symid.discrepancy.say.proof import proof_words, unproved
from symid.discrepancy.say.story import Story


def told(after: float, margin: float, free: Proof | None = None) -> str:
    runs = {
        "baseline_heldout": SimpleNamespace(errors=np.array([0.5]), recorded=np.ones((4, 1))),
        "augmented_heldout": SimpleNamespace(errors=np.array([after])),
    }
    model = SimpleNamespace(outputs={"seen": SimpleNamespace(unit="m", channel="seen")})
    story = SimpleNamespace(
        runs=runs,
        filter="known",
        effects=["something"],
        chance=None,
        model=model,
        proof=Proof(margin, 0.0, 6, 12.0, None, free),
    )
    story.error = lambda *errors: Story.error(story, *errors)
    return " ".join([*proof_words(story), *unproved(story)])


@pytest.mark.parametrize("free", [None, Proof(np.nan, 0.0, 6, 12.0, None)])
def test_a_run_that_diverges_is_no_number_and_speaks_against_what_was_found(free):
    words = told(np.nan, np.nan, free)
    assert "0.500 m to infinity, since it diverges" in words
    assert "does not confirm the finding" in words and "speak against this" in words
    assert "not known" not in words and "nan" not in words and "chance could do that" not in words


def test_a_run_that_ends_is_told_as_before():
    assert "goes from 0.500 m to 0.400 m: not confirmed, because chance could do that" in told(0.4, 0.2)
