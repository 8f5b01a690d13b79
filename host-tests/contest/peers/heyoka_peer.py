"""heyoka on the regularised equations: answers the commands of `src/programs/pipe.rs` on standard input.

Its Taylor series end at the peak (where the damping of adhesion begins) and at separation, which are its terminal events. Without
damping of adhesion the equations are the same before and after the peak, which is then passed over.

A run is timed twice: with all of its calls from Python, and with the same calls over no distance, in which no step is taken. The
difference is the solver's time.
"""

import sys
import time
from functools import cache

import heyoka
import numpy

RADIUS, SPEED, TIME, IMPULSE = range(4)
# Beyond every event.
FAR = 1e9
# More than any impact here takes: a series that misses its event would go on to the far end in tiny steps.
MOST_STEPS = 10_000
# What a propagation returns that ends at the first of its terminal events.
EVENT = heyoka.taylor_outcome(-1)
LANES = heyoka.recommended_simd_size()
BATCH = f"batch_of_{LANES}"


def equations(rebound, has_ring, outputs):
    """The rates of two quantities or four; the parameters are those of a scene, as far as the equations have them."""
    radius, speed, elapsed, impulse = heyoka.make_vars("s", "y", "t", "i")
    elastic, damping = heyoka.par[0], heyoka.par[1]
    square = radius * radius
    twice = square + square
    pull = -elastic * square * (1.0 + damping * speed)
    if has_ring:
        adhesion, ring_damping = heyoka.par[2], heyoka.par[3]
        pull += adhesion * (1.0 - ring_damping * speed) if rebound else adhesion
    rates = [(radius, speed), (speed, twice * pull)]
    if outputs:
        rates += [(elapsed, 2.0 * radius), (impulse, twice * elastic * square)]
    return rates, radius if rebound else speed


class Leg:
    """An integrator up to the peak, or up to separation."""

    def __init__(self, rebound, has_ring, outputs, tolerance, lanes):
        rates, event = equations(rebound, has_ring, outputs)
        self.parameters = (4 if rebound else 3) if has_ring else 2
        falling = heyoka.event_direction.negative
        if lanes:
            events = [heyoka.t_event_batch(event, direction=falling)]
            self.integrator = heyoka.taylor_adaptive_batch(
                rates, numpy.zeros((len(rates), lanes)), pars=numpy.ones((self.parameters, lanes)), tol=tolerance, t_events=events
            )
        else:
            events = [heyoka.t_event(event, direction=falling)]
            self.integrator = heyoka.taylor_adaptive(
                rates, numpy.zeros(len(rates)), pars=numpy.ones(self.parameters), tol=tolerance, t_events=events
            )
        # Both are views.
        self.state, self.pars = self.integrator.state, self.integrator.pars

    def begin(self, state, pars):
        self.state[:] = state
        self.pars[:] = pars[: self.parameters]

    def go(self, state, pars, end):
        """Whether the event is met before the end."""
        self.begin(state, pars)
        self.integrator.time = 0.0
        return self.integrator.propagate_until(end, max_steps=MOST_STEPS)[0] == EVENT

    def go_in_lanes(self, state, pars, calls):
        """How many calls it takes until each lane is at its event, since all of them stop where one meets it. So many calls over no
        distance if `calls` is not zero."""
        self.begin(state, pars)
        integrator = self.integrator
        integrator.set_time(0.0)
        ends = numpy.full(LANES, 0.0 if calls else FAR)
        count = 0
        while True:
            integrator.propagate_until(ends, max_steps=MOST_STEPS)
            count += 1
            for lane, result in enumerate(integrator.propagate_res):
                if result[0] == EVENT:
                    ends[lane] = integrator.time[lane]
                elif result[0] != heyoka.taylor_outcome.success and ends[lane] == FAR:
                    # A series of low order takes the start, where nothing changes yet, for the whole way, or diverges.
                    self.state[:] = numpy.nan
                    return count
            if count == calls or not (calls or FAR in ends):
                return count


class Peer:
    """The scenes, and the integrators that have been compiled."""

    def __init__(self):
        self.states, self.pars, self.has_ring = [], [], False
        self.leg = cache(Leg)
        self.passes = cache(self.passes_of)

    def read_scenes(self, lines):
        scenes = [[float(number) for number in line.split()] for line in lines]
        # Elasticity, damping, adhesion, damping of adhesion, as the equations number them.
        self.pars = [numpy.array([a, h, b, g]) for a, b, h, g, _ in scenes]
        self.states = [numpy.array([0.0, speed, 0.0, 0.0]) for *_, speed in scenes]
        self.has_ring = any(pars[2] != 0.0 for pars in self.pars)
        self.passes.cache_clear()

    def legs(self, method, tolerance, outputs):
        rebounds = (False, True) if self.has_ring else (True,)
        return [self.leg(rebound, self.has_ring, outputs, tolerance, LANES * (method == BATCH)) for rebound in rebounds]

    def passes_of(self, method, tolerance, outputs):
        """What solves all scenes and returns the states at separation, and what takes as many calls over no distance."""
        legs = self.legs(method, tolerance, outputs)
        count = 4 if outputs else 2
        states = [state[:count] for state in self.states]
        if method != BATCH:
            scenes = list(zip(states, self.pars))
            return lambda: solve_all(legs, scenes, FAR), lambda: solve_all(legs, scenes, 0.0)
        # The last batch is filled with the last scene.
        indices = numpy.minimum(numpy.arange(0, -(-len(states) // LANES) * LANES), len(states) - 1).reshape(-1, LANES)
        scenes = [(numpy.array([states[i] for i in group]).T, numpy.array([self.pars[i] for i in group]).T) for group in indices]
        _, calls = solve_in_lanes(legs, scenes, None)
        return lambda: solve_in_lanes(legs, scenes, None)[0], lambda: solve_in_lanes(legs, scenes, calls)

    def solve(self, *setting):
        whole, _ = self.passes(*setting)
        for state in whole()[: len(self.states)]:
            yield " ".join(repr(float(number)) for number in (*state[SPEED:], *[numpy.nan] * (4 - len(state))))

    def time(self, *setting, repeats):
        return [elapsed(one, repeats) for one in self.passes(*setting)]


def solve_all(legs, scenes, end):
    ends = []
    for state, pars in scenes:
        for leg in legs:
            met = leg.go(state, pars, end)
            state = leg.state.copy()
            if len(legs) == 2 and leg is legs[0]:
                state[SPEED] = 0.0
        ends.append(state if met else state + numpy.nan)
    return ends


def solve_in_lanes(legs, scenes, calls):
    """The states, and how many calls each leg of each batch took; `calls` says how many it takes over no distance."""
    ends, counts = [], []
    for state, pars in scenes:
        for leg in legs:
            counts.append(leg.go_in_lanes(state, pars, calls[len(counts)] if calls else 0))
            state = leg.state.copy()
            if len(legs) == 2 and leg is legs[0]:
                state[SPEED] = 0.0
        ends += list(state.T)
    return ends, counts


def elapsed(run, repeats):
    begin = time.perf_counter()
    for _ in range(repeats):
        run()
    return (time.perf_counter() - begin) / repeats


def main():
    peer = Peer()
    for line in iter(sys.stdin.readline, ""):
        command, *words = line.split()
        if command == "version":
            print(heyoka.__version__)
        elif command == "scenes":
            peer.read_scenes([sys.stdin.readline() for _ in range(int(words[0]))])
            print("one_by_one", *[BATCH] * (len(peer.states) >= LANES))
        else:
            method, tolerance, outputs, *repeats = words
            setting = method, float(tolerance), outputs == "1"
            if command == "solve":
                print("\n".join(peer.solve(*setting)))
            else:
                print(*peer.time(*setting, repeats=int(repeats[0])))
        sys.stdout.flush()


main()
