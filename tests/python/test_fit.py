#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""sheetstream.fit: what is found, how often it is within its errors, and what data do not tell."""
import unittest

import numpy as np

from sheetstream.fit import Parameter, fit

TIMES = np.linspace(0.1, 2, 12)
TRUE = {"size": 3.0, "rate": 0.7, "rest": 0.2}
RANGES = [Parameter("size", 0.1, 100, log=True), Parameter("rate", 0.01, 5), Parameter("rest", -1, 1)]


def decay(settings):
    return settings["size"] * np.exp(-TIMES * settings["rate"]) + settings["rest"]


def observe(many):
    return [decay(settings) for settings in many]


class Fits(unittest.TestCase):
    def test_exact_data(self):
        found = fit(RANGES, observe, decay(TRUE), 0.01)
        for key, value in TRUE.items():
            self.assertAlmostEqual(found.values[key], value, delta=0.02 * found.errors[key])
        self.assertTrue(found.converged)
        self.assertEqual(found.freedom, 9)
        np.testing.assert_allclose(found.fitted, decay(TRUE), atol=1e-3)

    def test_two_of_three_are_within_their_errors(self):
        within, chi2 = [], []
        for seed in range(100):
            noise = 0.02 * np.random.default_rng(seed).standard_normal(TIMES.size)
            found = fit(RANGES, observe, decay(TRUE) + noise, 0.02)
            within += [abs(found.values[key] - TRUE[key]) < found.errors[key] for key in TRUE]
            chi2.append(found.chi2)
        self.assertTrue(0.6 < np.mean(within) < 0.8, np.mean(within))
        self.assertTrue(8 < np.mean(chi2) < 10, np.mean(chi2))

    def test_errors_of_a_straight_line(self):
        found = fit([Parameter("slope", -5, 5), Parameter("start", -5, 5)],
                    lambda many: [s["slope"] * TIMES + s["start"] for s in many], 1.5 * TIMES - 0.5, 0.1)
        design = np.stack([TIMES, np.ones_like(TIMES)], axis=1)
        covariance = 0.01 * np.linalg.inv(design.T @ design)
        self.assertAlmostEqual(found.errors["slope"], covariance[0, 0]**0.5, places=6)
        self.assertAlmostEqual(found.errors["start"], covariance[1, 1]**0.5, places=6)
        self.assertAlmostEqual(found.correlations[0, 1], covariance[0, 1] / np.sqrt(np.prod(np.diag(covariance))),
                               places=4)

    def test_what_is_not_determined(self):
        found = fit([Parameter("a", 0.1, 100, log=True), Parameter("b", 0.1, 100, log=True)],
                    lambda many: [s["a"] * s["b"] * TIMES for s in many], 6 * TIMES, 0.1)
        self.assertAlmostEqual(found.values["a"] * found.values["b"], 6, places=3)
        self.assertEqual(found.unknown, ["a", "b"])
        self.assertRegex(found.summary(), r"nothing that was measured changes with a by -10 % and b by \+10 %")

    def test_ends_of_ranges_are_said(self):
        found = fit([Parameter("a", 0.1, 1)], lambda many: [[s["a"]] for s in many], [2], 0.1)
        self.assertIn("a is at the end of its range", found.undetermined)

    def test_bad_questions(self):
        for wrong, reason in ((lambda: Parameter("a", 1, 1), "range"), (lambda: Parameter("a", -1, 1, log=True), "log"),
                              (lambda: Parameter("a", 0, 1, start=2), "start"),
                              (lambda: fit([], observe, [1], 1), "no parameter"),
                              (lambda: fit(RANGES, observe, [1], 0), "positive"),
                              (lambda: fit(RANGES, observe, [1, 2], 1), "2 values were measured, but 12 observed")):
            with self.assertRaisesRegex(ValueError, reason):
                wrong()


if __name__ == "__main__":
    unittest.main()
