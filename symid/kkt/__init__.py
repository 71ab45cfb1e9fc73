"""Factorise the KKT matrices of collocation: a linear solver for Ipopt that sees the chain in them.

The matrix of an interior-point step is symmetric and indefinite. With collocation it is a chain of
small blocks, one for each node; episodes and recordings are chains side by side, or linked at their
starts; what all intervals share (parameters, lags) is a border of dense rows.

Order. The pattern alone tells it, so that Ipopt's restoration, second-order corrections and
limited-memory Hessians, which bring patterns of their own, need nothing else: the multipliers are the
longest tail without entries among themselves; unknowns with ten times the median's neighbours are
the border; the other variables, which stand in the order of time (`transcription.Layout`), are cut
into groups where least reaches across, between nodes; groups are eliminated by least degree (Tinney
and Walker 1967), of equals the one that waits longest, so that a chain burns from its ends to its
middle and linked episodes from their ends to their links; a row is eliminated with the first of its
groups that has a variable left for it.

Scaling. Rows and columns are brought near one by powers of two (Ruiz 2001), anew only when an entry
outgrows its last scales: else units decide on pivots, and Ipopt's regularisation (1e10 against 50 in
the equations) delays them without end.

Factorisation. Multifrontal L D L' (Duff and Reid 1983) with pivots of one or two columns (Bunch and
Kaufman 1977): of a front's fully summed columns the first whose multipliers stay below 1000, else
the best; a column without a pivot within the threshold is handed to the next front (delayed). The
exponential growth of unstable motion thereby turns into delayed pivots, never more than a few per node.
Inertia is counted from the pivots. The border's square is not carried from front to front: every
task adds up its part, 32 pivots at a time. Fronts are dense, columns contiguous and padded to eight
doubles. Subtrees are tasks for threads; all sums have a fixed order, so that any number of threads
gives the same bits.

Cost. With b unknowns a node (variables and multipliers), a frontier of c unknowns (the next node's
variables, b/2 for one-step schemes) and p border unknowns, a node takes about
b (b^2/6 + b (c+p)/2 + (c+p)^2/2) multiplications and b (b/2 + c + p) numbers of the factor: linear in
nodes and episodes. The full-state feedback model (b = 8, c = 4, p = 10): 1300 and 144, in memory 175
with pivots and delays, besides 9 for the entries' scales. Only the front at hand is padded; what is
kept for solves is packed; where a front's entries stand in Ipopt's values is kept as steps from the front
before, which fronts alike share. Measured on its 5001 nodes, one core with AVX-512: analysis
11 ms, factorisation 5 to 7, solution 2 for one right side; Ipopt's linear systems take a third of
what they take with MUMPS (`symid bench`). One with half of AVX2's width in hardware (EPYC 7001): 25,
14 and 2.7 ms, and two fifths of MUMPS.

Interface. The library exports the entry points that Ipopt loads for its solver "ma27"; they are
written from Ipopt's calls (IpMa27TSolverInterface.cpp), and hold nothing of HSL.
"""

from symid.kkt.library import KEEP_BYTES, Statistics, begin, end, library_path

__all__ = ["KEEP_BYTES", "Statistics", "begin", "end", "library_path"]
