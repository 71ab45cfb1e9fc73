"""Straight-line programs: numbered operations, each written once and only using earlier ones.

Equal operations get the same number, so that what two expressions share is computed once. The
constructors simplify just enough to drop zeros and ones, and to gather factors that are the
same at all points, so that these can be computed once outside of the loop over points.
"""

from __future__ import annotations

from collections.abc import Container, Iterable
from math import inf

FOREIGN = "C "  # before the name of a function that the user gives, as an operation
NUMBER, UNIFORM, POINT = range(3)  # how often a value changes: never, once per call, at each point


def foreign_name(op: str) -> str:
    """How C names a foreign operation: ``drag``, ``drag_01``."""
    base, places = op.removeprefix(FOREIGN).split(" ")
    return f"{base}_{places}" if places else base


class Graph:
    """Operations `ops[k]` with operands `args[k]` (numbers of earlier operations) and `level[k]`."""

    def __init__(self):
        self.ops: list[str] = []
        self.args: list[tuple] = []
        self.level: list[int] = []
        self.foreign_texts: dict[str, str] = {}  # C function -> its source
        self._known: dict[tuple, int] = {}
        self.zero, self.one = self.number(0.0), self.number(1.0)

    # ---- leaves and plain operations ---------------------------------------------------
    def _leaf(self, op: str, key, level: int) -> int:
        k = self._known.get((op, key))
        if k is None:
            k = self._known[op, key] = len(self.ops)
            self.ops.append(op)
            self.args.append((key,))
            self.level.append(level)
        return k

    def number(self, value: float) -> int:
        return self._leaf("number", float(value) + 0.0, NUMBER)  # + 0.0 makes one zero of the two

    def symbol(self, key: str, level: int) -> int:
        return self._leaf("symbol", key, level)

    def call(self, op: str, *args: int) -> int:
        """Operation `op` as it is, without simplification."""
        k = self._known.get((op, args))
        if k is None:
            k = self._known[op, args] = len(self.ops)
            self.ops.append(op)
            self.args.append(args)
            self.level.append(max(UNIFORM, *(self.level[a] for a in args)))
        return k

    def foreign(self, base: str, places: str, text: str, *args: int) -> int:
        """A derivative of the user's C function `base` by the arguments at `places`."""
        self.foreign_texts[base] = text
        return self.call(f"{FOREIGN}{base} {places}", *args)

    def value(self, a: int) -> float | None:
        """The number that `a` is, or None."""
        return self.args[a][0] if self.ops[a] == "number" else None

    # ---- arithmetic --------------------------------------------------------------------
    def neg(self, a: int) -> int:
        if self.ops[a] == "number":
            return self.number(-self.args[a][0])
        if self.ops[a] == "neg":
            return self.args[a][0]
        if self.ops[a] == "sub":
            return self.call("sub", *reversed(self.args[a]))
        if self.ops[a] == "mul" and self.ops[self.args[a][0]] == "number":
            return self.mul(self.neg(self.args[a][0]), self.args[a][1])
        return self.call("neg", a)

    def _scaled(self, a: int) -> tuple[int, int]:
        """(c, x) with a = c * x and c the same at all points."""
        if self.level[a] < POINT:
            return a, self.one
        if self.ops[a] == "mul" and self.level[self.args[a][0]] < POINT:
            return self.args[a]
        return self.one, a

    def add(self, a: int, b: int) -> int:
        if a == self.zero or b == self.zero:
            return a if b == self.zero else b
        if self.ops[a] == self.ops[b] == "number":
            return self.number(self.args[a][0] + self.args[b][0])
        if self.ops[a] == "neg" or self.ops[b] == "neg":
            if self.ops[b] != "neg":
                a, b = b, a
            return self.sub(a, self.args[b][0])
        if self.ops[a] == self.ops[b] == "select" and self.args[a][0] == self.args[b][0]:
            (c, x, y), (_, u, v) = self.args[a], self.args[b]
            return self.select(c, self.add(x, u), self.add(y, v))
        (c, x), (d, y) = self._scaled(a), self._scaled(b)
        if x == y != self.one:
            return self.mul(self.add(c, d), x)
        if c == d != self.one and self.one not in (x, y):
            return self.mul(c, self.add(x, y))
        return self.call("add", *self._ordered(a, b))

    def sub(self, a: int, b: int) -> int:
        if a == b:
            return self.zero
        if a == self.zero:
            return self.neg(b)
        if b == self.zero:
            return a
        if self.ops[a] == self.ops[b] == "number":
            return self.number(self.args[a][0] - self.args[b][0])
        if self.ops[b] == "neg":
            return self.add(a, self.args[b][0])
        if self.ops[a] == "neg":
            return self.neg(self.add(self.args[a][0], b))
        (c, x), (d, y) = self._scaled(a), self._scaled(b)
        if x == y != self.one:
            return self.mul(self.sub(c, d), x)
        if c == d != self.one and self.one not in (x, y):
            return self.mul(c, self.sub(x, y))
        return self.call("sub", a, b)

    def _ordered(self, a: int, b: int) -> tuple[int, int]:
        return (a, b) if (self.level[a], a) <= (self.level[b], b) else (b, a)

    def mul(self, a: int, b: int) -> int:
        if self.zero in (a, b):
            return self.zero
        if self.one in (a, b):
            return b if a == self.one else a
        if self.ops[a] == self.ops[b] == "number":
            return self.number(self.args[a][0] * self.args[b][0])
        for x, y in ((a, b), (b, a)):
            if self.ops[x] == "neg":
                return self.neg(self.mul(self.args[x][0], y))
            if self.value(x) == -1.0:
                return self.neg(y)
        for x, y in ((a, b), (b, a)):
            # 0 * (what a branch not taken gives) would be NaN where that branch is undefined
            if self.ops[x] == "select" and self.zero in self.args[x][1:]:
                c, u, v = self.args[x]
                return self.select(c, self.mul(u, y), self.mul(v, y))
        if self.level[a] < POINT and self.level[b] < POINT:
            return self._uniform_product(a, b)
        (c, x), (d, y) = self._scaled(a), self._scaled(b)
        factor, rest = self.mul(c, d), x if y == self.one else y
        if self.one not in (x, y):
            rest = self.call("mul", *self._ordered(x, y))
        if factor == self.one:
            return rest
        if self.ops[factor] == "neg" or self.value(factor) == -1.0:
            return self.neg(self.mul(self.neg(factor), rest))
        return self.call("mul", factor, rest)

    def _uniform_product(self, a: int, b: int) -> int:
        """The product of two values that are the same at all points, its number in front."""
        (c, x), (d, y) = self._numbered(a), self._numbered(b)
        number = self.mul(c, d)
        rest = x if y == self.one else y if x == self.one else self.call("mul", *self._ordered(x, y))
        if number == self.one:
            return rest
        return self.neg(rest) if self.value(number) == -1.0 else self.call("mul", number, rest)

    def _numbered(self, a: int) -> tuple[int, int]:
        """(c, x) with a = c * x and c a number."""
        if self.ops[a] == "number":
            return a, self.one
        if self.ops[a] == "mul" and self.ops[self.args[a][0]] == "number":
            return self.args[a]
        return self.one, a

    def inv(self, a: int) -> int:
        """1 / a. The only division: one slow operation serves a quotient and its derivatives."""
        if self.ops[a] == "number":
            return self.number(1.0 / self.args[a][0] if self.args[a][0] else inf)
        if self.ops[a] == "inv":
            return self.args[a][0]
        if self.ops[a] == "neg":
            return self.neg(self.inv(self.args[a][0]))
        c, x = self._scaled(a)
        if self.one not in (c, x):
            return self.mul(self.inv(c), self.inv(x))
        return self.call("inv", a)

    def power(self, a: int, n: int) -> int:
        """a to an integer power, by repeated squaring."""
        if n < 0:
            return self.inv(self.power(a, -n))
        if n == 0:
            return self.one
        half = self.power(a, n // 2)
        square = self.mul(half, half)
        return self.mul(square, a) if n % 2 else square

    def select(self, condition: int, a: int, b: int) -> int:
        """a where the condition holds, b elsewhere."""
        return a if a == b else self.call("select", condition, a, b)

    def total(self, terms: Iterable[int]) -> int:
        """The sum, in an order that gathers what is the same at all points."""
        s = self.zero
        for t in sorted(terms, key=lambda k: self.level[k]):
            s = self.add(s, t)
        return s

    def product(self, factors: Iterable[int]) -> int:
        p = self.one
        for f in sorted(factors, key=lambda k: self.level[k]):
            p = self.mul(p, f)
        return p

    # ---- looking at it -----------------------------------------------------------------
    def operands(self, k: int) -> tuple[int, ...]:
        return () if self.ops[k] in ("number", "symbol") else self.args[k]

    def needed(self, outputs: Iterable[int], given: Container[int] = ()) -> list[int]:
        """The operations on which `outputs` depend, in order; what those that are `given` depend on is left out."""
        seen, stack = set(), list(outputs)
        while stack:
            k = stack.pop()
            if k not in seen:
                seen.add(k)
                stack.extend(() if k in given else self.operands(k))
        return sorted(seen)
