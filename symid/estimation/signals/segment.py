"""A segment of a recording, and its simulation from a state of its own."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from symid.simulation import Signals, Simulator, Trajectory

FEWEST = 8
"""Samples of the shortest segment."""
FAINT = 0.1
"""Part of an error that counts where what was before a segment is known badly: of a person under random forces a sample
more of it changed twice the log-likelihood by 230 at a lag of 0.10 s and by 60 at 0.11 s, and a muscle lag of 4 ms made
up for that (`person` 714 of tests/examination). Left out altogether, where the run begins is not determined."""
MET = 1e-9
"""A delay of a whole number of samples is one but for so small a part of a sample."""


@dataclass(frozen=True, eq=False)
class Segment:
    """One stretch of recording.

    Attributes
    ----------
    time : (N,) [s].
    recorded : (N, m) in the order of the model's outputs, SI.
    inputs : channel -> ((N - 1) ratio + 1,) SI.
    ratio : samples of the inputs for each of the outputs, more than one where only some outputs are compared.
    earlier : (E,) times and channel -> (E,) inputs of the recording before this stretch, for inputs that act late.
    undone : (N, m) the part of `recorded` that undoing a filter added, where its cutoff is to be estimated.
    """

    time: np.ndarray
    recorded: np.ndarray
    inputs: Mapping[str, np.ndarray]
    ratio: int = 1
    undone: np.ndarray | None = None
    earlier: tuple[np.ndarray, Mapping[str, np.ndarray]] | None = None
    _given: dict[tuple, Signals] = field(default_factory=dict, init=False, repr=False)

    @property
    def step(self) -> float:
        return float(np.median(np.diff(self.time)))

    @property
    def input_step(self) -> float:
        """Seconds between samples of the inputs."""
        return self.step / self.ratio

    def head(self, n: int) -> Segment:
        """The first `n` samples."""
        return self.part(slice(n))

    def part(self, rows: slice) -> Segment:
        """Some of the samples, of inputs as well as of outputs."""
        first, last, every = rows.indices(len(self.time))
        fine = slice(first * self.ratio, (last - 1) * self.ratio + 1, every)
        keep = np.ascontiguousarray
        return Segment(
            keep(self.time[rows]),
            keep(self.recorded[rows]),
            {k: keep(v[fine]) for k, v in self.inputs.items()},
            self.ratio,
            None if self.undone is None else keep(self.undone[rows]),
            self._before(first * self.ratio, len(self.time[rows]) * self.ratio),
        )

    def _before(self, first: int, most: int) -> tuple[np.ndarray, Mapping[str, np.ndarray]] | None:
        """At most so many samples of the inputs before their sample `first`."""
        if first == 0 or not self.inputs:
            return self.earlier
        time, before = self.earlier or (np.zeros(0), {k: np.zeros(0) for k in self.inputs})
        fine = np.interp(np.arange(first) / self.ratio, np.arange(len(self.time)), self.time)
        inputs = {k: np.concatenate([u, self.inputs[k][:first]])[-most:] for k, u in before.items()}
        return np.concatenate([time, fine])[-most:], inputs

    def sparser(self, every: int) -> Segment:
        """Every so-many-th sample of the outputs, all samples of the inputs."""
        rows = slice(None, None, every)
        time = np.ascontiguousarray(self.time[rows])
        fine = (len(time) - 1) * every * self.ratio + 1
        return Segment(
            time,
            np.ascontiguousarray(self.recorded[rows]),
            {k: v[:fine] for k, v in self.inputs.items()},
            every * self.ratio,
            None if self.undone is None else np.ascontiguousarray(self.undone[rows]),
            self.earlier,
        )

    def sharpened(self, sharpness: float) -> Segment:
        """The segment with so many times the part that undoing a filter added."""
        if self.undone is None or sharpness == 1.0:
            return self
        return replace(self, recorded=self.recorded + (sharpness - 1) * self.undone, undone=sharpness * self.undone)

    def simulate(
        self,
        simulator: Simulator,
        parameters,
        initial_state,
        gain: np.ndarray | None = None,
        *,
        gain_slopes: np.ndarray | None = None,
        substeps: int = 1,
        late: np.ndarray | None = None,
        unknown: float = 0.0,
        **options,
    ) -> Trajectory:
        """A run over this segment, corrected by its samples where there is a `gain`, reported at its samples.

        Parameters
        ----------
        gain, gain_slopes : as of `Simulator.simulate`, for the past at samples of the inputs.
        substeps : of the integrator in each sample of the outputs; at least one in each of the inputs.
        late : (m,) [s] how late each output is. Of what was before the segment nobody knows the motion: until an output
            shows what came later nothing is compared, and the run is said to meet the recording.
        unknown : for so many seconds [s] states are read that nobody knows well, so that what is compared there counts
            little. It still tells where the run begins.
        options : of `Simulator.simulate`, but no `noise`.
        """
        unseen = self._unseen(late)
        run = simulator.simulate(
            parameters,
            initial_state,
            self._signals(simulator),
            gain=gain,
            gain_slopes=gain_slopes,
            recorded=self._compared if unseen is None else self._compared_after(unseen),
            substeps=-(-substeps // self.ratio),
            **options,
        )
        run = run if self.ratio == 1 else run.every(self.ratio)
        run = self._meeting(run, int(self._rows(unknown)), FAINT) if unknown > 0 else run
        return run if unseen is None else self._meeting(run, int(unseen.max()), 0.0)

    def _unseen(self, late: np.ndarray | None) -> np.ndarray | None:
        """(m,) first samples of each output that show what was before the segment; None where none does."""
        return None if late is None or not np.any(late > 0) else self._rows(late)

    def _rows(self, seconds: float | np.ndarray) -> np.ndarray:
        """Samples in so many seconds from the first on, fewer than there are."""
        return np.minimum(np.ceil(seconds / self.step - MET).astype(int), len(self.time) - 1)

    def _compared_after(self, unseen: np.ndarray) -> np.ndarray:
        """`_compared` without the first (m,) `unseen` samples of each output."""
        recorded = self._compared.copy()
        for j, rows in enumerate(unseen):
            recorded[: rows * self.ratio, j] = np.nan
        return recorded

    def _meeting(self, run: Trajectory, rows: int, part: float) -> Trajectory:
        """The run with all but this part of its errors left out of its first `rows` samples."""
        y, dy = run.y.copy(), None if run.dy is None else run.dy.copy()
        # Where nothing is kept an output may be no number, since it shows what nobody knows.
        y[:rows] = self.recorded[:rows] + (part * (y[:rows] - self.recorded[:rows]) if part else 0.0)
        if dy is not None:
            dy[:rows] *= part
        return replace(run, y=y, dy=dy, unseen=rows)

    def _signals(self, simulator: Simulator) -> Signals:
        """The inputs as a simulator is given them, which is the same for all that take the same ones."""
        source = simulator.source
        key = source.inputs, tuple(source.input_between), len(source.noises)
        if key not in self._given:
            n = (len(self.time) - 1) * self.ratio + 1
            time = np.interp(np.arange(n) / self.ratio, np.arange(len(self.time)), self.time)
            self._given[key] = simulator.signals(time, self.inputs, earlier=self.earlier)
        return self._given[key]

    @cached_property
    def _compared(self) -> np.ndarray:
        """`recorded` at all samples of the inputs, NaN where nothing is compared."""
        recorded = np.full(((len(self.time) - 1) * self.ratio + 1, self.recorded.shape[1]), np.nan)
        recorded[:: self.ratio] = self.recorded
        return recorded
