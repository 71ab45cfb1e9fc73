"""A model whose bounds leave out the true value, of which the diagnosis tells."""

from driven_cart import cart, recorded

from symid.discrepancy import diagnose, suspects


def test_a_parameter_at_its_bound_is_told():
    """A spring is found that makes up for it, beside which the parameter leaves its bound."""
    model = cart().with_bounds(stiffness=(0.0, 20.0))
    of = [s for s in suspects(model) if s.term.name in ("torsional_spring", "coulomb_friction")]
    found = diagnose(
        model, recorded(duration=30), fit_window=(0.0, 20.0), held_out=(20.0, 30.0), suspects=of, threads=1
    )
    assert [e.name for e in found.effects] == ["torsional_spring"]
    assert "stiffness lies at its bound (20 N/m)" in found.words
    assert "damping lies at its bound" not in found.words
