"""Figure 2 of Wang & van den Bogert 2020: how the stable share grows with the number of episodes."""

from __future__ import annotations

from collections.abc import Sequence

from symid.plots.style import MODEL, RECORDED, Picture, opened, plain_ticks

TESTS = (("eigenvalue_percent", "by eigenvalues"), ("forward_percent", "by forward simulation"))


def plot_stable_share(findings: Sequence) -> Picture:
    """Stable share [%] against episodes, one panel per controller and test, beside the article's.

    Parameters
    ----------
    findings : of a Reproduction, with ``case``, ``seed`` and ``stability``.
    """
    controllers = list(dict.fromkeys(f.case.controller for f in findings))
    picture = Picture(figsize=(3.1 * len(controllers) + 0.6, 4.6), layout="constrained")
    axes = picture.subplots(2, len(controllers), squeeze=False, sharey=True)
    for column, controller in zip(axes.T, controllers, strict=True):
        own = [f for f in findings if f.case.controller == controller]
        episodes = [f.case.episodes for f in own]
        for axis, (test, _) in zip(column, TESTS, strict=True):
            opened(axis)
            axis.plot(episodes, [getattr(f.case, test) for f in own], "o", color=RECORDED, ms=9, label="article")
            axis.plot(episodes, [getattr(f.stability, test) for f in own], "x", color=MODEL, ms=7, label="symid")
            axis.set_xticks(sorted(set(episodes)))
            axis.set_ylim(-4, 104)
        column[0].set_title(controller, fontsize=9)
        column[-1].set_xlabel("episodes")
    for axis, (_, words) in zip(axes[:, 0], TESTS, strict=True):
        axis.set_ylabel(f"stable share [%]\n{words}", fontsize=9)
    picture.legend(
        *axes[0, 0].get_legend_handles_labels(), loc="outside upper right", ncols=2, frameon=False, fontsize=8
    )
    return picture


def plot_starts_spread(findings: Sequence) -> Picture:
    """RMS [deg] of all solved starts of every case, beside the article's ten."""
    picture = Picture(figsize=(7.2, 3.4), layout="constrained")
    axis = picture.subplots()
    opened(axis)
    for i, f in enumerate(findings):
        solved = f.starts[f.starts["solved"]]["rms_deg"]
        axis.plot(
            [i - 0.12] * len(f.case.rms_deg),
            f.case.rms_deg,
            "o",
            color=RECORDED,
            ms=5,
            label="article" if not i else None,
        )
        axis.plot([i + 0.12] * len(solved), solved, "x", color=MODEL, ms=5, label="symid" if not i else None)
    axis.set_xticks(range(len(findings)), [f.case.name for f in findings], rotation=45, fontsize=8)
    axis.set_yscale("log")
    plain_ticks(axis.yaxis)
    axis.set_ylabel("RMS [deg]")
    axis.legend(
        frameon=False, fontsize=8, ncols=2, loc="lower right", bbox_to_anchor=(1, 1)
    )  # above: starts may end anywhere
    return picture
