"""Water, its surface and values between particles against what is known of lattices."""

from __future__ import annotations

import numpy as np
import pytest
from courant.post.particles import (
    ParticleSet,
    Points,
    SprayRule,
    first_surface,
    interpolate,
    spline_norm,
    spline_shape,
    water_body,
    water_on_lines,
)
from made_runs import DX, block, frame, lattice, scatter


def cubic_spline(r, h, dim):
    return spline_norm(h, dim) * spline_shape(r / h)


def everything(state) -> ParticleSet:
    return ParticleSet.of(state, np.ones(len(state), dtype=bool))


def line(*x: float) -> np.ndarray:
    return np.array([[one, 0, 0] for one in x])


@pytest.mark.parametrize("dim", [2, 3])
def test_the_kernel_integrates_to_one(dim):
    h, dr = 0.3, 1e-4
    r = np.arange(dr / 2, 2 * h, dr)
    shells = 2 * np.pi * r if dim == 2 else 4 * np.pi * r**2
    assert (cubic_spline(r, np.full_like(r, h), dim) * shells * dr).sum() == pytest.approx(1, abs=1e-6)


class TestFirstSurface:
    def depth(self, *places, x=0.05, bed=0.0):
        return first_surface(everything(frame(*places)), line(x), bed)[0]

    @pytest.mark.parametrize("rows", [2, 4, 10, 17])
    def test_flat_water_is_as_deep_as_its_rows(self, rows):
        for x in (0.05, 0.0512):
            assert self.depth(lattice(x1=0.1, y1=rows * DX), x=x) == pytest.approx(rows * DX, abs=0.1 * DX)

    def test_one_row_and_a_bed_elsewhere(self):
        assert self.depth(lattice(x1=0.1, y1=DX)) == pytest.approx(DX, abs=0.15 * DX)
        assert self.depth(lattice(x1=0.1, y0=0.3, y1=0.35), bed=0.3) == pytest.approx(10 * DX, abs=0.1 * DX)

    def test_spray_above_a_gap_does_not_count(self):
        calm, sheet = lattice(x1=0.1, y1=8 * DX), lattice(x1=0.1, y0=12 * DX, y1=14 * DX)
        assert self.depth(calm, sheet) == pytest.approx(self.depth(calm), abs=1e-12)
        assert self.depth(calm, np.array([[0.05, 9.5 * DX, 0]])) < 9 * DX

    @pytest.mark.parametrize("gap, depth", [(1.0, 13), (1.1, 13.1), (1.4, 4), (2.0, 4)])  # spacings; h is 1.2
    def test_a_gap_thinner_than_h_is_no_surface(self, gap, depth):
        over = lattice(x1=0.1, y0=0.0, y1=8 * DX) + [0, (4 + gap) * DX, 0]
        assert self.depth(lattice(x1=0.1, y1=4 * DX), over) == pytest.approx(depth * DX, abs=0.1 * DX)

    def test_gaps_count_one_by_one(self):
        rows = [lattice(x1=0.1, y1=2 * DX) + [0, at * DX, 0] for at in (0, 3, 6, 9.5)]  # gaps of 1, 1 and 1.5 spacings
        assert self.depth(*rows) == pytest.approx(8 * DX, abs=0.1 * DX)

    def test_dry_bed(self):
        assert self.depth(lattice(x1=0.1, y1=8 * DX), x=0.5) == 0
        assert self.depth(lattice(x1=0.1, y0=4 * DX, y1=12 * DX)) == 0
        assert self.depth() == 0

    def test_lines_that_cannot_be_deep_enough_may_be_left_out(self):
        some, x = everything(frame(lattice(x1=0.5, y1=0.02), lattice(x0=0.3, x1=0.5, y0=0.02, y1=0.08))), np.arange(0.05, 0.5, 0.01)
        all_depths, deep = first_surface(some, line(*x), 0), first_surface(some, line(*x), 0, over=0.05)
        assert np.array_equal(all_depths > 0.05, deep > 0.05) and np.array_equal(all_depths[deep > 0], deep[deep > 0]) and (deep == 0).sum() > 20


class TestWaterBody:
    def test_a_plate_under_a_detached_drop(self):
        plate, drop = lattice(x1=0.5, y1=0.05), lattice(x0=0.24, x1=0.26, y0=0.07, y1=0.08)
        both = everything(frame(plate, drop))
        water = water_body(both, SprayRule())
        assert len(water) == len(plate)
        pieces, _ = water_on_lines(water, line(0.25), 1)
        assert pieces.low == pytest.approx([0], abs=0.1 * DX) and pieces.high == pytest.approx([0.05], abs=0.1 * DX)
        pieces, _ = water_on_lines(both, line(0.25), 1)  # both surfaces of the drop are seen where it counts
        assert pieces.low[1] == pytest.approx(0.07, abs=0.25 * DX) and pieces.high[1] == pytest.approx(0.08, abs=0.25 * DX)
        assert len(water_body(both, SprayRule(share=0))) == len(both)

    def test_a_drop_that_touches_belongs_to_the_water(self):
        drop = np.array([[0.2525, 0.05 + (k + 0.5) * DX, 0] for k in range(4)])
        both = everything(frame(lattice(x1=0.5, y1=0.05), drop))
        assert len(water_body(both, SprayRule())) == len(both)

    def test_two_basins_both_count(self):
        both = everything(frame(lattice(x1=0.5, y1=0.05), lattice(x0=0.6, x1=0.7, y1=0.05)))  # a sixth of the water
        assert len(water_body(both, SprayRule())) == len(both) > len(water_body(both, SprayRule(share=0.3)))

    def test_the_rule_cuts_at_its_link(self):
        for gap, count in ((1.75, 60), (1.85, 40)):  # spacings; link times h is 1.8
            halves = lattice(x1=0.05, y1=0.02), lattice(x0=0.045 + gap * DX, x1=0.07 + gap * DX, y1=0.02)
            assert len(water_body(everything(frame(*halves)), SprayRule(share=0.5))) == count

    def test_no_particles(self):
        water = water_body(everything(frame()), SprayRule())
        pieces, filled = water_on_lines(water, line(0), 1)
        assert len(water) == 0 and len(pieces.line) == 0 and filled.tolist() == [0]


class TestWaterOnLines:
    def test_an_overhang_has_several_pieces(self):
        tongue = lattice(x0=0.1, x1=0.3, y0=0.06, y1=0.09), lattice(x0=0.1, x1=0.12, y0=0.03, y1=0.06)
        water = water_body(everything(frame(lattice(x1=0.5, y1=0.03), *tongue)), SprayRule())
        pieces, _ = water_on_lines(water, line(0.4, 0.2, 3), 1)
        assert pieces.line.tolist() == [0, 1, 1]
        assert pieces.high == pytest.approx([0.03, 0.03, 0.09], abs=0.1 * DX) and pieces.low[2] == pytest.approx(0.06, abs=0.1 * DX)

    def test_pieces_with_thin_gaps_are_joined_line_by_line(self):
        from courant.post.particles import Pieces, joined

        pieces = Pieces(np.array([0, 0, 0, 2, 2]), np.array([0.0, 1.5, 4.0, 0.2, 3.0]), np.array([1.0, 3.0, 5.0, 2.0, 4.0]))
        one = joined(pieces, 1.0)  # a gap of just 1 is a cavity
        assert one.line.tolist() == [0, 0, 2, 2] and one.low.tolist() == [0, 4, 0.2, 3] and one.high.tolist() == [3, 5, 2, 4]
        assert [len(part) for part in joined(Pieces(*(part[:0] for part in pieces)), 1.0)] == [0, 0, 0]

    def test_filled_is_the_volume_of_the_particles(self):
        state = frame(lattice(x1=0.5, y1=0.05))
        state.V *= 0.95  # sparse particles: the surface stays, the volume shrinks
        pieces, filled = water_on_lines(everything(state), line(0.2512, 3), 1)
        assert pieces.high == pytest.approx([0.05], abs=0.1 * DX)
        assert filled == pytest.approx([0.95 * 0.05, 0], abs=0.002 * 0.05)

    @pytest.mark.parametrize("axis", [0, 1, 2])
    def test_along_each_axis_in_space(self, axis):
        water = water_body(everything(frame(block(10, 12, 14), dim=3)), SprayRule())
        pieces, _ = water_on_lines(water, np.array([[5 * DX, 6 * DX, 7 * DX]]), axis)
        assert pieces.low == pytest.approx([0], abs=0.1 * DX) and pieces.high == pytest.approx([(10 + 2 * axis) * DX], abs=0.1 * DX)

    def test_the_columns_are_sums_over_the_kernel(self):
        from courant.post.particles import colour_columns, lines_near

        some = everything(frame(lattice(x1=0.1, y1=0.05, jitter=0.7)))
        some.h[::3] *= 0.8
        places, dy = line(0.03, 0.061), 0.001
        near, k, aside = lines_near(some, places, 1)
        C = colour_columns(some, near, k, aside, some.x[k, 1] + 0.02, (2, 100), dy)
        y = -0.02 + dy * np.arange(100)
        for row, x in enumerate((0.03, 0.061)):
            r = np.hypot(some.x[:, 0] - x, some.x[:, 1] - y[:, None])
            assert C[row] == pytest.approx((some.V * cubic_spline(r, some.h, 2)).sum(axis=1), abs=1e-13)


class TestInterpolation:
    @staticmethod
    def linear(x):
        return 3 + 20 * x[:, 0] - 50 * x[:, 1] + 7 * x[:, 2]

    def largest_error(self, places, linear, of):
        some = everything(frame(places))
        x, y = np.meshgrid(np.arange(0, 0.2, 0.0013), np.arange(0, 0.1, 0.0017))
        points = Points(np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)]))
        weights = interpolate(some, points, linear, 1e-9)
        assert not weights.fallback.any()
        return np.abs(weights.of(of(some.x)) - of(points.x)).max()

    @pytest.mark.parametrize("jitter", [0.0, 0.6])
    def test_mls_is_exact_for_linear_fields_on_any_particles(self, jitter):
        places = lattice(x1=0.2, jitter=jitter)
        assert self.largest_error(places, True, self.linear) < 1e-10  # at the edges, too
        assert self.largest_error(places, False, self.linear) > 1e-2

    def test_shepard_is_exact_for_constants(self):
        assert self.largest_error(lattice(x1=0.2, jitter=0.6), False, lambda x: np.full(len(x), 4.0)) < 1e-13

    def test_in_space(self):
        places = block(8, 8, 8, 0.01) + 0.004 * scatter(3 * 512).reshape(-1, 3)
        some = everything(frame(places, dim=3, dx=0.01))
        points = Points(np.array([[0.035, 0.041, 0.027], [0.01, 0.06, 0.068]]))
        assert interpolate(some, points, True, 0.1).of(self.linear(some.x)) == pytest.approx(self.linear(points.x), abs=1e-10)
        assert interpolate(some, points, False, 0.1).colour == pytest.approx([1, 1], abs=0.3)

    def test_colour_tells_water(self):
        some = everything(frame(lattice(x1=0.2)))
        weights = interpolate(some, Points(np.array([[0.1, 0.05, 0], [0.1, 0.1, 0], [0.1, 0.2, 0], [1e30, -1e30, 0]])), True, 0.1)
        assert weights.colour == pytest.approx([1, 0.5, 0, 0], abs=0.05) and set(weights.point) == {0, 1}

    def test_particles_in_a_line_fall_back_to_shepard(self):
        some = everything(frame(np.column_stack([0.005 * np.arange(10), np.zeros(10), np.zeros(10)])))
        weights = interpolate(some, Points(np.array([[0.021, 0.001, 0.0]])), True, 0.1)
        assert weights.fallback.all() and weights.of(np.full(10, 2.0)) == pytest.approx([2], abs=1e-14)

    def test_a_particle_far_away_costs_nothing(self):
        some = everything(frame(lattice(x1=0.1, jitter=0.8), np.array([[1e6, -1e6, 0.0]])))
        weights = interpolate(some, Points(np.array([[0.05, 0.05, 0], [1e6, -1e6, 0]])), False, 0.1)
        for p, x in enumerate(((0.05, 0.05), (1e6, -1e6))):
            near = np.hypot(some.x[:, 0] - x[0], some.x[:, 1] - x[1]) < 2 * 0.006
            assert (weights.point == p).sum() == near.sum() > 0
