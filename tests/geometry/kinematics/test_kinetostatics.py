"""Forces in joints: against one linear system of all links, the energy of the whole, textbooks, substitute masses."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest

from geometry.base.record import replace
from geometry.curves.curve import Complex, Real
from geometry.kinematics.kinetostatics import (
    Acting,
    Body,
    Reactions,
    Toothed,
    by_zhukovsky,
    frames,
    inertial,
    power,
    reactions,
    reduced_inertia,
    weight,
)
from geometry.kinematics.levers import Levers, Moved, Rods, Slider, Stone
from tests.geometry.kinematics.test_levers import MECHANISMS

TURN = np.linspace(0.1, 0.1 + 2 * math.pi, 13)[:-1]
GRAVITY = cmath.rect(9.81, -2.0)
RUNNING = {name: replace(levers, change=-3.0 * levers.speed) for name, levers in MECHANISMS.items()}


def bodies_of(levers: Levers) -> list[Body]:
    """One of each link, off its line, unlike the others."""
    return [
        Body(str(k), 2.0 + k, 0.01 * k, levers.crank * complex(0.3 + 0.1 * k, 0.05 * k - 0.2))
        for k in range(1, levers.links + 1)
    ]


def loads(levers: Levers, at: Moved) -> list[Acting]:
    """Weights, inertia, a force off the frame's origin and a couple on every link."""
    moving, found = frames(levers, at), []
    for body in bodies_of(levers):
        frame = moving[body.link]
        found += [weight(body, GRAVITY, frame), inertial(body, frame)]
    for k, (link, frame) in enumerate(moving.items()):
        same = np.ones(np.shape(frame.way[0]))
        found.append(Acting(link, levers.crank * (0.2 - 0.1j * k), 300 * cmath.exp(1j * k) * same, 5000.0 * k * same))
    return found


def pairs(levers: Levers, at: Moved) -> dict[str, tuple[Complex, Complex | None]]:
    """By two links where their pair is, and the normal of a sliding one."""
    place = {name: at.place(name) for name in at.points}
    ones = np.ones(np.shape(place["A"]))
    found: dict[str, tuple[Complex, Complex | None]] = {"01": (0j * ones, None), "12": (place["A"], None)}
    for rod, last, joint, group in (("2", "3", "B", levers.first), ("4", "5", "D", levers.second)):
        if isinstance(group, Stone):
            lever = place["A"] - group.pivot
            found["23"] = (place["A"], 1j * lever / abs(lever))
        elif group is not None:
            found[rod + last] = (place[joint], None)
        if isinstance(group, Slider):
            found["0" + last] = (place[joint], 1j * cmath.exp(1j * group.angle) * ones)
        elif group is not None:
            found["0" + last] = (group.pivot * ones, None)
    if levers.second is not None:
        found["34"] = (place["C"], None)
    return found


def at_once(levers: Levers, at: Moved, acting: list[Acting]) -> tuple[dict[str, Complex], dict[str, Real], Real]:
    """All joints by one system: three balances of every link, about O1, in positions taken one by one."""
    moving, joints = frames(levers, at), pairs(levers, at)
    many, size = len(np.atleast_1d(at.place("A"))), 3 * levers.links
    unit = levers.crank
    forces = {name: np.zeros(many, complex) for name in joints}
    couples = {name: np.zeros(many) for name, (_, normal) in joints.items() if normal is not None}
    moment = np.zeros(many)
    for k in range(many):
        columns: list[tuple[str, str, complex]] = []
        for name, (_, normal) in joints.items():
            columns += [(name, "f", 1), (name, "f", 1j)] if normal is None else [(name, "f", normal[k]), (name, "c", 0)]
        matrix, right = np.zeros((size, size)), np.zeros(size)
        for j, (name, what, way) in enumerate(columns):
            spot = joints[name][0][k] / unit
            for link, sign in ((int(name[0]), -1), (int(name[1]), 1)):
                if link:
                    row = 3 * (link - 1)
                    turn = 1.0 if what == "c" else (spot.conjugate() * way).imag
                    matrix[row : row + 3, j] += sign * np.array([complex(way).real, complex(way).imag, turn])
        matrix[2, size - 1] = 1
        for one in acting:
            row, spot = 3 * (int(one.link) - 1), moving[one.link].point(one.at)[0][k] / unit
            force = one.force[k]
            right[row : row + 3] -= [force.real, force.imag, (spot.conjugate() * force).imag + one.couple[k] / unit]
        solved = np.linalg.solve(matrix, right)
        for (name, what, way), value in zip(columns, solved, strict=False):
            if what == "f":
                forces[name][k] += way * value
            else:
                couples[name][k] = value * unit
        moment[k] = solved[-1] * unit
    return forces, couples, moment


@pytest.mark.parametrize("name", RUNNING)
def test_groups_one_by_one_give_what_one_system_of_all_links_gives(name: str) -> None:
    levers = RUNNING[name]
    at = levers.moved(TURN)
    acting = loads(levers, at)
    found = reactions(levers, at, acting)
    forces, couples, moment = at_once(levers, at, acting)
    scale = max(np.abs(f).max() for f in forces.values())
    assert found.forces.keys() == forces.keys()
    assert found.couples.keys() == couples.keys()
    for pair, force in forces.items():
        assert np.abs(found.forces[pair] - force).max() < 1e-12 * scale, pair
    for pair, couple in couples.items():
        assert np.abs(found.couples[pair] - couple).max() < 1e-11 * scale * levers.crank, pair
    assert np.abs(found.moment - moment).max() < 1e-11 * scale * levers.crank


@pytest.mark.parametrize("name", RUNNING)
def test_the_powers_of_all_forces_add_up_to_nothing(name: str) -> None:
    levers = RUNNING[name]
    at = levers.moved(TURN)
    acting, moving = loads(levers, at), frames(levers, at)
    found = reactions(levers, at, acting)
    powers = [power(one, moving[one.link]) for one in acting] + [found.moment * levers.speed / 1000]
    assert (np.abs(sum(powers)) < 1e-12 * sum(map(np.abs, powers))).all()
    lever = by_zhukovsky(acting, moving, levers.speed)
    assert (np.abs(found.moment - lever) * levers.speed / 1000 < 1e-12 * sum(map(np.abs, powers))).all()


@pytest.mark.parametrize("name", RUNNING)
def test_the_balancing_moment_is_what_the_energy_of_the_links_asks(name: str) -> None:
    """M_b omega = d/dt (T + U): T by places and speeds alone, its slope a difference quotient."""
    levers, h = RUNNING[name], 1e-4
    bodies = bodies_of(levers)
    for angle in (0.4, 2.2, 5.0):
        at = levers.moved(angle + h * np.array([-2, -1, 0, 1, 2]))
        moving = frames(levers, at)
        inertia = reduced_inertia(bodies, moving, levers.speed)
        height = sum(
            -body.mass * np.real(np.conj(GRAVITY) * moving[body.link].point(body.centre)[0]) / 1000 for body in bodies
        )
        energy = inertia * levers.speed**2 / 2 + height
        slope = (energy[0] - 8 * energy[1] + 8 * energy[3] - energy[4]) / 12 / h
        wanted = slope + inertia[2] * levers.change
        acting = [f(body, a, moving[body.link]) for body in bodies for f, a in ((weight, GRAVITY),)]
        acting += [inertial(body, moving[body.link]) for body in bodies]
        moment = reactions(levers, at, acting).moment[2] / 1000
        assert moment == pytest.approx(wanted, abs=1e-8 * (np.abs(energy).max() + inertia[2] * levers.speed**2))


@pytest.mark.parametrize("name", RUNNING)
def test_substitute_masses_of_a_rod_pass_on_what_the_rod_does(name: str) -> None:
    """Three masses on a rod's line with its mass, its centre and its inertia are the rod."""
    levers = RUNNING[name]
    link, length = next(
        (link, group.rod)
        for link, group in (("4", levers.second), ("2", levers.first))
        if isinstance(group, Rods | Slider)
    )
    at = levers.moved(TURN)
    frame = frames(levers, at)[link]
    mass, share, inertia = 7.0, 0.35, 2e-7 * length**2
    first = inertia / (share * (length / 1000) ** 2)
    last = inertia / ((1 - share) * (length / 1000) ** 2)
    spots = [(first, 0.0), (last, length), (mass - first - last, share * length)]
    assert sum(m * x for m, x in spots) == pytest.approx(mass * share * length, rel=1e-12)
    whole = reactions(levers, at, [inertial(Body(link, mass, inertia, share * length), frame)])
    parts = reactions(levers, at, [inertial(Body(link, m, 0.0, x), frame) for m, x in spots])
    _same(whole, parts, 1e-12)


def _same(one: Reactions, other: Reactions, near: float, factor: float = 1.0) -> None:
    scale = max(np.abs(f).max() for f in other.forces.values()) * factor
    for pair, force in other.forces.items():
        assert np.abs(one.forces[pair] - factor * force).max() <= near * scale, pair
    # against the greatest force at an arm of a metre
    for pair, couple in other.couples.items():
        assert np.abs(one.couples[pair] - factor * couple).max() <= near * scale * 1000, pair
    assert np.abs(one.moment - factor * other.moment).max() <= near * scale * 1000


@pytest.mark.parametrize("factor", [1e-9, 1e-3, 1e6, 1e9])
@pytest.mark.parametrize("name", ["screen", "six bars", "compressor"])
def test_forces_grow_as_the_masses_do(name: str, factor: float) -> None:
    levers = RUNNING[name]
    at = levers.moved(TURN)
    moving = frames(levers, at)

    def found(scale: float) -> Reactions:
        bodies = [replace(b, mass=b.mass * scale, inertia=b.inertia * scale) for b in bodies_of(levers)]
        return reactions(levers, at, [inertial(b, moving[b.link]) for b in bodies])

    _same(found(factor), found(1.0), 1e-13, factor)


def test_a_light_link_beside_heavy_ones_keeps_its_own_balance() -> None:
    """Masses from 1e-9 to 1e9 in one mechanism: every link is in balance to the rounding of what acts on it."""
    levers = RUNNING["screen"]
    at = levers.moved(TURN)
    moving = frames(levers, at)
    masses = {"1": 1e9, "2": 1e-9, "3": 1e3, "4": 1e-9, "5": 1e9}
    acting = [inertial(Body(link, mass, 0.0, 50 + 10j), moving[link]) for link, mass in masses.items()]
    found = reactions(levers, at, acting).forces
    for link, into, out in (("2", "12", "23"), ("4", "34", "45")):
        own = sum(a.force for a in acting if a.link == link)
        assert np.abs(found[into] + own - found[out]).max() <= 1e-15 * np.abs(found[into]).max()
    sums = found["01"] + found["03"] + found["05"] + sum(a.force for a in acting)
    assert np.abs(sums).max() < 1e-12 * max(np.abs(a.force).max() for a in acting)


def test_without_loads_nothing_is_passed_on() -> None:
    for levers in RUNNING.values():
        at = levers.moved(TURN)
        moving = frames(levers, at)
        found = reactions(levers, at, [inertial(Body(link, 0.0), frame) for link, frame in moving.items()])
        assert not any(np.any(f) for f in (*found.forces.values(), *found.couples.values(), found.moment))


def test_a_piston_force_by_the_textbook() -> None:
    """Rod force F / cos(beta), side thrust F tan(beta), crank moment F r sin(phi + beta) / cos(beta)."""
    r, rod, force = 70.0, 210.0, 5000.0
    levers = Levers(r, 150.0, Slider(rod))
    at = levers.moved(TURN)
    still = np.zeros(len(TURN))
    found = reactions(levers, at, [Acting("3", 0j, -force + 0j + still, still)])
    beta = np.arcsin(r * np.sin(TURN) / rod)
    assert np.allclose(np.abs(found.forces["12"]), force / np.cos(beta), rtol=1e-13)
    assert np.allclose(found.forces["03"], 1j * force * np.tan(beta), rtol=1e-12, atol=1e-9)
    assert np.allclose(found.forces["01"], force * (1 - 1j * np.tan(beta)), rtol=1e-12)
    # the gas presses the piston to the shaft: on the way out the crank must push
    assert np.allclose(found.moment, -force * r * np.sin(TURN + beta) / np.cos(beta), rtol=1e-11)
    assert not found.couples["03"].any()
    # off the pin's line by 4 mm: the guide holds the moment, so its resultant stands M / N beside the pin
    aside = reactions(levers, at, [Acting("3", 4j, -force + 0j + still, still)])
    assert np.allclose(aside.couples["03"], -4 * force, rtol=1e-14)
    assert np.allclose(aside.moment, found.moment, rtol=1e-13)


def test_a_massive_piston_at_its_dead_centres() -> None:
    """F = m r w^2 (1 +- r / l) along the line of stroke."""
    r, rod, w, mass = 70.0, 210.0, 150.0, 3.0
    levers = Levers(r, w, Slider(rod))
    at = levers.moved(np.array([0.0, math.pi]))
    found = reactions(levers, at, [inertial(Body("3", mass), frames(levers, at)["3"])])
    pull = mass * r / 1000 * w**2
    assert np.allclose(found.forces["12"], [-pull * (1 + r / rod), pull * (1 - r / rod)], rtol=1e-12, atol=1e-9)
    assert np.abs(found.moment).max() < 1e-9 * pull * r


def test_a_wheel_on_the_crank_presses_its_shaft() -> None:
    """F_t = M / r, radial F_t tan(alpha) away from the pinion, line of action r cos(alpha) from O1, either sense."""
    levers = RUNNING["conveyor"]
    at = levers.moved(TURN)
    acting = loads(levers, at)
    alone = reactions(levers, at, acting)
    assert alone.moment.min() < 0 < alone.moment.max()
    teeth = Toothed(120.0, math.radians(20), 0.7)
    found = reactions(levers, at, acting, teeth)
    assert np.array_equal(found.moment, alone.moment)
    spot, out = 120 * cmath.exp(0.7j), cmath.exp(0.7j)
    assert np.allclose(np.imag(np.conj(spot) * found.driving), alone.moment, rtol=1e-12)
    assert np.allclose(np.abs(found.driving), np.abs(alone.moment) / (120 * math.cos(teeth.pressure)), rtol=1e-13)
    assert (np.real(found.driving / out) < 0).all()
    assert np.allclose(found.forces["01"] + found.driving, alone.forces["01"], rtol=1e-12)


def test_a_four_bar_of_norton() -> None:
    """Norton, Design of Machinery, example 11-3: 5, 15, 10 and 19 in, centres of mass off the links' lines, 80 lb on
    the coupler and 120 lb in on the rocker. The book's inertia is in lb s^2 / in, its results in lb and lb in.
    """
    inch, pound = 25.4, 4.4482216152605
    slug = pound / (inch / 1000)
    levers = Levers(5 * inch, 25.0, Rods(19 * inch + 0j, 15 * inch, 10 * inch, -1), 10 * inch, change=-40.0)
    at = levers.moved(np.radians([60.0]))
    assert np.degrees([at.angle("2")[0], at.angle("3")[0]]) == pytest.approx([20.92, 104.41], abs=0.005)
    assert [at.turning("2")[1][0], at.turning("3")[1][0]] == pytest.approx([120.9, 276.29], abs=0.05)
    moving = frames(levers, at)

    def body(link: str, mass: float, inertia: float, far: float, angle: float) -> Body:
        centre = cmath.rect(far * inch, math.radians(angle))
        return Body(link, mass * slug, inertia * slug * (inch / 1000) ** 2, centre)

    bodies = [body("1", 0.004, 0.4, 3, 30), body("2", 0.02, 1.5, 9, 45), body("3", 0.015, 0.8, 5, 0)]
    acting = [inertial(one, moving[one.link]) for one in bodies]
    found = [2 * moving[one.link].point(one.centre)[2][0] / inch for one in bodies]
    assert np.abs(found) == pytest.approx([1878.84, 3646.1, 1416.8], abs=0.05)
    assert np.degrees(np.angle(found)) % 360 == pytest.approx([273.66, 226.51, 207.24], abs=0.005)
    one, none = np.ones(1), np.zeros(1)
    place = bodies[1].centre + cmath.rect(3 * inch, math.radians(100))
    acting.append(Acting("2", place, 80 * pound * cmath.exp(1j * math.radians(330)) * one, none))
    acting.append(Acting("3", 0j, 0j * one, 120 * pound * inch * one))
    result = reactions(levers, at, acting)
    frame = result.forces["01"][0] / pound
    assert (frame.real, frame.imag) == pytest.approx((-117.65, -107.84), abs=0.005)
    assert result.moment[0] / pound / inch == pytest.approx(243.23, abs=0.005)


def test_groups_bite_by_the_sine_between_their_rods() -> None:
    """90 degrees less what the triangle of a four-bar asks: cos(mu) by the law of cosines; a rod against its guide."""
    rods = RUNNING["conveyor"].first
    assert isinstance(rods, Rods)
    levers = Levers(100.0, 10.0, rods, 210.0)
    at = levers.moved(TURN)
    far = np.abs(at.place("A") - rods.pivot)
    cosine = (rods.rod**2 + rods.rocker**2 - far**2) / (2 * rods.rod * rods.rocker)
    assert np.allclose(reactions(levers, at, []).bite, np.sqrt(1 - cosine**2), rtol=1e-12)
    levers = RUNNING["compressor"]
    at = levers.moved(TURN)
    assert isinstance(levers.first, Slider)
    lean = (at.place("A").imag - 12) / levers.first.rod
    assert np.allclose(reactions(levers, at, []).bite, np.sqrt(1 - lean**2), rtol=1e-12)
    # of two groups the one that holds worse: here now the first, now the second
    levers = RUNNING["mirrored"]
    at = levers.moved(TURN)
    assert isinstance(levers.second, Slider)
    between = np.abs(np.sin(at.angle("2") - at.angle("3")))
    against = np.abs(np.cos(at.angle("4") - levers.second.angle))
    assert 0 < (between < against).sum() < len(TURN)
    assert np.allclose(reactions(levers, at, []).bite, np.minimum(between, against), rtol=1e-12)
    # a stone that all but passes the pivot of its lever has no arm there
    levers = Levers(50.0, 1.0, Stone(50.05j), 200.0)
    assert reactions(levers, levers.moved(np.array([math.pi / 2, -math.pi / 2])), []).bite == pytest.approx([1e-3, 1])
