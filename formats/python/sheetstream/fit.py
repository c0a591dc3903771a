# SPDX-License-Identifier: MIT
"""Which parameters of a scene give what was measured: weighted least squares, with errors and correlations, and with
what the measurements do not tell. scipy is needed.

>>> from sheetstream.fit import Parameter, fit
>>> def observe(many):
...     return [[3e6 / settings["material.viscosity"]] for settings in many]
>>> viscosity = Parameter("material.viscosity", 1e6, 1e8, log=True)
>>> result = fit([viscosity], observe, values=[0.6], sigmas=0.03, difference=1e-4)
>>> f"{result.values['material.viscosity']:.3g} +- {result.errors['material.viscosity']:.2g}"
'5e+06 +- 2.5e+05'

`observe` is given a list of settings, a number for each parameter's key, and returns for each the numbers that would be
measured there: a run of the ring for each, side by side as it likes. `pipelines/fit` does that for a scene.
"""
from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Settings = dict[str, float]
Observe = Callable[[list[Settings]], Sequence[npt.ArrayLike]]

UNKNOWN = 0.3  # a standard error above this part of a parameter's range: the data do not tell it


@dataclass(frozen=True)
class Parameter:
    """A key of the scene between two values in SI units, taken as its logarithm if `log`; first tried at `start`, or in
    the middle."""
    key: str
    low: float
    high: float
    log: bool = False
    start: float | None = None

    def __post_init__(self) -> None:
        if not (math.isfinite(self.low) and math.isfinite(self.high) and self.low < self.high):
            raise ValueError(f"{self.key}: a range goes from a number to a greater one")
        if self.log and self.low <= 0:
            raise ValueError(f"{self.key}: the range of a logarithm is positive")
        if self.start is not None and not self.low <= self.start <= self.high:
            raise ValueError(f"{self.key}: its start is not within its range")

    def value(self, part: float) -> float:
        """At a part of the way from low to high."""
        if self.log:
            return self.low * (self.high / self.low) ** part
        return self.low + part * (self.high - self.low)

    def part(self, value: float) -> float:
        if self.log:
            return math.log(value / self.low) / math.log(self.high / self.low)
        return (value - self.low) / (self.high - self.low)

    def slope(self, part: float) -> float:
        """Of the value by the part."""
        return self.value(part) * math.log(self.high / self.low) if self.log else self.high - self.low


@dataclass(frozen=True)
class Fit:
    """What was found. `values`, `errors` (one standard deviation) in SI units by key; `correlations` of the parameters;
    `chi2` over `freedom` is 1 where scene and measurements agree within their sigmas; `fitted` what the best values
    give; `unknown` the keys that the data do not tell, `undetermined` sentences about them; `trials` how often settings
    were observed."""
    values: Settings
    errors: Settings
    correlations: Floats
    chi2: float
    freedom: int
    fitted: Floats
    unknown: list[str] = field(default_factory=list)
    undetermined: list[str] = field(default_factory=list)
    trials: int = 0
    converged: bool = True

    def summary(self) -> str:
        lines = [f"{key} = {value:.6g}" + (f" +- {self.errors[key]:.2g}" if key not in self.unknown else "")
                 for key, value in self.values.items()]
        keys = list(self.values)
        lines += [f"correlation of {keys[i]} and {keys[j]}: {self.correlations[i, j]:.3f}"
                  for i in range(len(keys)) for j in range(i)]
        lines.append(f"chi2 = {self.chi2:.4g} with {self.freedom} degrees of freedom, {self.trials} runs")
        return "\n".join([*lines, *self.undetermined])


def fit(parameters: Sequence[Parameter], observe: Observe, values: npt.ArrayLike, sigmas: npt.ArrayLike,
        difference: float = 0.01, tolerance: float = 1e-4, trials: int = 100) -> Fit:
    """The parameters that give `values` with the least sum of ((observed - value)/sigma)^2 [Gauss 1809], by a trust
    region within their ranges [Branch, Coleman and Li 1999]; slopes by differences of `difference` of the ranges. Ends
    where a step is below `tolerance` of the ranges. Errors are those of the linearized problem.
    """
    from scipy.optimize import least_squares
    measured = np.asarray(values, dtype=np.float64)
    sigma = np.broadcast_to(np.asarray(sigmas, dtype=np.float64), measured.shape)
    if not parameters:
        raise ValueError("nothing to fit: no parameter")
    if measured.size == 0 or not (np.isfinite(measured).all() and np.isfinite(sigma).all() and (sigma > 0).all()):
        raise ValueError("measured values are finite, at least one of them, and their sigmas are positive")
    known: dict[tuple[float, ...], Floats] = {}

    def residuals_at(points: list[tuple[float, ...]]) -> list[Floats]:
        new = [point for point in dict.fromkeys(points) if point not in known]
        settings = [{p.key: p.value(x) for p, x in zip(parameters, point)} for point in new]
        for point, observed in zip(new, observe(settings) if new else []):
            numbers = np.asarray(observed, dtype=np.float64)
            if numbers.shape != measured.shape:
                raise ValueError(f"{measured.size} values were measured, but {numbers.size} observed")
            known[point] = (numbers - measured) / sigma
        return [known[point] for point in points]

    def residuals(x: Floats) -> Floats:
        return residuals_at([tuple(float(part) for part in x)])[0]

    def slopes(x: Floats) -> Floats:
        point = tuple(float(part) for part in x)
        steps = [difference if part + difference <= 1 else -difference for part in point]
        moved = [(*point[:i], point[i] + step, *point[i + 1:]) for i, step in enumerate(steps)]
        here, *there = residuals_at([point, *moved])
        return np.stack([(other - here) / step for other, step in zip(there, steps)], axis=1)

    start = [p.part(p.start) if p.start is not None else 0.5 for p in parameters]
    found = least_squares(residuals, start, jac=slopes, bounds=(0, 1), method="trf", xtol=tolerance, ftol=1e-10,
                          gtol=1e-12, max_nfev=trials)
    return _judge(parameters, found.x, found.fun, slopes(found.x), measured, sigma, len(known), bool(found.success))


def _judge(parameters: Sequence[Parameter], x: Floats, residual: Floats, jacobian: Floats, measured: Floats,
           sigma: Floats, trials: int, converged: bool) -> Fit:
    """Errors, correlations and what is not determined, from the slopes at the best point."""
    _, sizes, directions = np.linalg.svd(jacobian, full_matrices=False)
    sizes = np.maximum(sizes, 1e-12 * max(1e-300, float(sizes.max(initial=0))))
    covariance = (directions.T / sizes**2) @ directions if len(residual) >= len(x) else np.full((len(x),) * 2, np.inf)
    errors = np.sqrt(np.diag(covariance))
    with np.errstate(invalid="ignore", divide="ignore"):
        correlations = covariance / np.outer(errors, errors)
    keys = [p.key for p in parameters]
    unknown = [key for key, error in zip(keys, errors) if not error < UNKNOWN]
    undetermined = [f"{key} is not determined by these data" for key in unknown]
    if len(unknown) > 1:
        undetermined.append("(" + _kept_constant(parameters, x, directions[-1]) + ")")
    at_end = [f"{key} is at the end of its range" for key, part in zip(keys, x) if not 1e-3 < part < 1 - 1e-3]
    return Fit({p.key: p.value(part) for p, part in zip(parameters, x)},
               {p.key: abs(p.slope(part)) * error for p, part, error in zip(parameters, x, errors)}, correlations,
               float(residual @ residual), len(residual) - len(x), residual * sigma + measured, unknown,
               [*undetermined, *at_end], trials, converged)


def _kept_constant(parameters: Sequence[Parameter], x: Floats, free: Floats) -> str:
    """The way along which nothing that was measured changes."""
    relative = np.array([c * p.slope(float(part)) / p.value(float(part)) for p, part, c in zip(parameters, x, free)])
    relative *= 10 / np.abs(relative).max()
    changes = [f"{p.key} by {change:+.2g} %" for p, change in zip(parameters, relative) if abs(change) > 0.1]
    return "nothing that was measured changes with " + " and ".join(changes)
