#!/usr/bin/env python3
"""exact_values.py [--check] FILE.csv: makes the values of FILE (box_spline_values.csv) again, at its points, and prints the whole file; with --check
it prints nothing and says by status 1, and a line for each row that differs, that the file holds others.

Shares nothing with the program's own splines: everything is computed in rationals from definitions and rounded to doubles once.
Box splines by the recursion of C. de Boor, K. Hoellig, S. Riemenschneider, Box Splines, Springer 1993; B-splines by that of de Boor; the Catmull-Rom
generator by the pyramid of P. Barry and R. Goldman, 1988, doi:10.1145/54852.378511; cosines of cwlb by their series in 40 digits.
"""
import functools
import itertools
import math
import sys
from decimal import Decimal, getcontext
from fractions import Fraction

getcontext().prec = 60
AXES = ((2, 0, 0), (0, 2, 0), (0, 0, 2))
DIAGONALS = ((-1, 1, 1), (1, -1, 1), (1, 1, -1), (-1, -1, -1))


def determinant(a, b, c):
    return (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]))


def spans_space(directions):
    return any(determinant(*triple) for triple in itertools.combinations(directions, 3))


@functools.lru_cache(None)
def least_norm_rows(directions):
    """Rows r with t_r = r . x for the t of least norm that gives x = sum t_r xi_r: xi_r^T (X X^T)^-1."""
    gram = [[sum(Fraction(d[i] * d[j]) for d in directions) for j in range(3)] for i in range(3)]
    whole = determinant(*gram)
    unit = [[Fraction(int(i == j)) for j in range(3)] for i in range(3)]
    inverse = [[determinant(*[unit[column] if row == k else gram[k] for k in range(3)]) / whole for column in range(3)] for row in range(3)]
    # Cramer's rule gives the transposed inverse row by row; X X^T is symmetric.
    return [tuple(sum(inverse[i][k] * d[k] for k in range(3)) for i in range(3)) for d in directions]


class BoxSpline:
    """Of integral 1, its cube [0,1]^n beginning in the origin: not centred. Right at points on no knot plane."""

    def __init__(self, directions):
        self.directions = tuple(directions)
        self.known = {}

    def at(self, directions, x):
        low = [sum(min(d[i], 0) for d in directions) for i in range(3)]
        high = [sum(max(d[i], 0) for d in directions) for i in range(3)]
        if any(not low[i] < x[i] < high[i] for i in range(3)) or not spans_space(directions):
            return Fraction(0)
        key = (directions, x)
        if key not in self.known:
            self.known[key] = self.recurse(directions, x)
        return self.known[key]

    def recurse(self, directions, x):
        t = [sum(row[i] * x[i] for i in range(3)) for row in least_norm_rows(directions)]
        n = len(directions)
        if n == 3:
            return Fraction(1, abs(determinant(*directions))) if all(0 <= c < 1 for c in t) else Fraction(0)
        total = Fraction(0)
        for r in range(n):
            fewer = directions[:r] + directions[r + 1:]
            shifted = tuple(x[i] - directions[r][i] for i in range(3))
            total += t[r] * self.at(fewer, x) + (1 - t[r]) * self.at(fewer, shifted)
        return total / (n - 3)

    def jet(self, x):
        """Value and gradient of the centred one."""
        self.known.clear()
        corner = tuple(x[i] + Fraction(sum(d[i] for d in self.directions), 2) for i in range(3))
        along = [self.difference(corner, r) for r in range(len(self.directions))]
        return self.at(self.directions, corner), self.gradient(along)

    def difference(self, x, r):
        """The derivative along direction r: a difference of the box spline without it."""
        fewer = self.directions[:r] + self.directions[r + 1:]
        return self.at(fewer, x) - self.at(fewer, tuple(x[i] - self.directions[r][i] for i in range(3)))

    def gradient(self, along):
        triple = next(t for t in itertools.combinations(range(len(self.directions)), 3) if determinant(*[self.directions[r] for r in t]))
        rows = [self.directions[r] for r in triple]
        whole = determinant(*rows)
        return tuple(determinant(*[[along[triple[k]] if column == i else rows[k][column] for column in range(3)] for k in range(3)]) / Fraction(whole)
                     for i in range(3))


def b_spline(degree, x):
    """The centred cardinal B-spline."""
    def uncentred(n, y):
        if n == 0:
            return Fraction(int(0 <= y < 1))
        return (y * uncentred(n - 1, y) + (n + 1 - y) * uncentred(n - 1, y - 1)) / n
    return uncentred(degree, x + Fraction(degree + 1, 2))


def b_spline_slope(degree, x):
    return b_spline(degree - 1, x + Fraction(1, 2)) - b_spline(degree - 1, x - Fraction(1, 2))


def catmull_rom(x):
    """Value and slope at x of the curve through 1 at 0 and 0 at every other integer: a pyramid of linear interpolations."""
    first = math.floor(x) - 1
    knots = [Fraction(first + k) for k in range(4)]

    def blend(a, b, low, high):  # of (value, slope) pairs between knots low and high
        w, width = (x - low) / (high - low), high - low
        return ((1 - w) * a[0] + w * b[0], (1 - w) * a[1] + w * b[1] + (b[0] - a[0]) / width)

    points = [(Fraction(int(k == 0)), Fraction(0)) for k in knots]
    ones = [blend(points[i], points[i + 1], knots[i], knots[i + 1]) for i in range(3)]
    twos = [blend(ones[i], ones[i + 1], knots[i], knots[i + 2]) for i in range(2)]
    return blend(twos[0], twos[1], knots[1], knots[2])


def product(parts, scale=Fraction(1)):
    """Of three (value, slope) pairs, one for each axis."""
    value = scale * parts[0][0] * parts[1][0] * parts[2][0]
    gradient = tuple(scale * math.prod((parts[b][1 if a == b else 0] for b in range(3)), start=Fraction(1)) for a in range(3))
    return value, gradient


def tensor(degree):
    return lambda x: product([(b_spline(degree, c), b_spline_slope(degree, c)) for c in x])


def cosets(x):
    return product([(b_spline(3, c / 2), b_spline_slope(3, c / 2) / 2) for c in x], Fraction(1, 2))


@functools.lru_cache(None)
def pi():
    def arctangent_of_inverse(n):
        return sum((-1 if k % 2 else 1) * Decimal(1) / ((2 * k + 1) * Decimal(n) ** (2 * k + 1)) for k in range(60))
    return 16 * arctangent_of_inverse(5) - 4 * arctangent_of_inverse(239)


def cosine_and_sine(x):
    """Of a small x, a Decimal."""
    sums = [Decimal(0), Decimal(0)]
    term = Decimal(1)
    for k in range(80):
        sums[k % 2] += term if k % 4 < 2 else -term
        term = term * x / (k + 1)
    return sums


def cosine_weighted(x):
    """a(x) L(x/2), a = 1/2 + (cos pi x + cos pi y + cos pi z) / 6, L the product of 1 - |x_i|."""
    decimal = lambda q: Decimal(q.numerator) / Decimal(q.denominator)
    circle = pi()
    waves = [cosine_and_sine(circle * decimal(c)) for c in x]
    weight = Decimal(1) / 2 + sum(w[0] for w in waves) / 6
    hats = [(max(1 - abs(decimal(c)) / 2, Decimal(0)), Decimal(-1 if c > 0 else 1) / 2 if abs(c) < 2 else Decimal(0)) for c in x]
    value = hats[0][0] * hats[1][0] * hats[2][0]
    slopes = [math.prod((hats[b][1 if a == b else 0] for b in range(3)), start=Decimal(1)) for a in range(3)]
    return weight * value, tuple(weight * slopes[a] - circle * waves[a][1] / 6 * value for a in range(3))


def box(directions):
    spline = BoxSpline(directions)

    def jet(x):
        value, gradient = spline.jet(x)
        return 4 * value, tuple(4 * g for g in gradient)
    return jet


GENERATORS = {
    "bcc4": box(DIAGONALS),
    "bcc7": box(AXES + DIAGONALS),
    "bcc8": box(DIAGONALS + DIAGONALS),
    "bcc12": cosets,
    "cwlb": cosine_weighted,
    "trilinear": tensor(1),
    "triquadratic": tensor(2),
    "tricubic": tensor(3),
    "catmull-rom": lambda x: product([catmull_rom(c) for c in x]),
}


def row(line):
    name, *numbers = line.split(",")
    place = numbers[:3]
    value, gradient = GENERATORS[name](tuple(Fraction(float(c)) for c in place))
    return ",".join([name, *place, *(repr(float(v)) for v in (value, *gradient))])


def main(arguments):
    check = arguments[:1] == ["--check"]
    if len(arguments) != 1 + check:
        sys.exit(__doc__)
    differing = 0
    with open(arguments[-1], encoding="ascii") as file:
        for line in file.read().splitlines():
            made = line if line.startswith("#") else row(line)
            if not check:
                print(made)
            elif made != line:
                differing += 1
                print(f"found    {line}\nexpected {made}")
    sys.exit(1 if differing else 0)


if __name__ == "__main__":
    main(sys.argv[1:])
