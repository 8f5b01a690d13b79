// Boost.odeint on the regularised equations: answers the commands of `src/programs/pipe.rs` on standard input.
//
// Each solver finds the peak (where the damping of adhesion begins) and separation on the step in which speed or contact radius changes
// its sign: on its dense output, or, where it has none, by shorter repetitions of that step. Without damping of adhesion the equations
// are the same before and after the peak, which is then passed over.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <boost/numeric/odeint.hpp>

namespace odeint = boost::numeric::odeint;
namespace ublas = boost::numeric::ublas;

namespace {

// Before the first error estimate, in a contact that takes 2.5 without damping.
constexpr double FIRST_STEP = 0.1;
// Beyond which a solver gives up.
constexpr int MOST_STEPS = 1000000;
// A radius and a speed are below one: what is larger is none.
constexpr double LARGEST = 1e3;
// Indices of the state.
enum { RADIUS, SPEED, TIME, IMPULSE };

// Damping below which an implicit solver takes a hundred times as long as explicit ones.
constexpr double STIFF = 10.0;

struct Scene {
    double elastic, adhesion, damping, ring_damping, speed;
};

// The equations; the state has two quantities, or four with time and elastic impulse.
struct Equations {
    Scene scene;
    bool rebound;

    double ring_damping() const { return rebound ? scene.ring_damping : 0.0; }

    template <class State> void operator()(const State &x, State &rates, double) const {
        const double s = x[RADIUS], y = x[SPEED];
        const double square = s * s, twice = square + square, elastic = scene.elastic * square;
        rates[RADIUS] = y;
        rates[SPEED] = twice * (scene.adhesion * (1.0 - ring_damping() * y) - elastic * (1.0 + scene.damping * y));
        if (x.size() > 2) {
            rates[TIME] = s + s;
            rates[IMPULSE] = twice * elastic;
        }
    }
};

struct Jacobian {
    Equations equations;

    void operator()(const ublas::vector<double> &x, ublas::matrix<double> &jacobian, double, ublas::vector<double> &by_time) const {
        const Scene &scene = equations.scene;
        const double s = x[RADIUS], y = x[SPEED], square = s * s, g = equations.ring_damping();
        jacobian.clear();
        by_time.clear();
        jacobian(RADIUS, SPEED) = 1.0;
        jacobian(SPEED, RADIUS) = 4.0 * s * (scene.adhesion * (1.0 - g * y) - 2.0 * scene.elastic * square * (1.0 + scene.damping * y));
        jacobian(SPEED, SPEED) = -2.0 * square * (scene.adhesion * g + scene.elastic * square * scene.damping);
        if (x.size() > 2) {
            jacobian(TIME, RADIUS) = 2.0;
            jacobian(IMPULSE, RADIUS) = 8.0 * scene.elastic * s * square;
        }
    }
};

struct Point {
    double place, value;
};

// Goes to where `value` changes its sign from positive at `low` to not positive at `high`, by the Illinois method.
template <class Value> void sign_change(Point low, Point high, Value value) {
    for (int i = 0; i < 60; ++i) {
        const double place = low.place - low.value * (high.place - low.place) / (high.value - low.value);
        const double at_place = value(place);
        if (std::abs(at_place) < 1e-15) break;
        if (at_place > 0.0) {
            low = {place, at_place}, high.value *= 0.5;
        } else {
            high = {place, at_place}, low.value *= 0.5;
        }
    }
}

// The equations as an explicit and as an implicit solver takes them.
struct Explicit {
    Equations operator()(const Equations &equations) const { return equations; }
};
struct Implicit {
    std::pair<Equations, Jacobian> operator()(const Equations &equations) const { return {equations, {equations}}; }
};

// A solver with dense output.
template <class State, class Form, class Make> struct Dense {
    Make make;

    bool leg(const Equations &equations, State &x, int event, double &step) const {
        const auto system = Form{}(equations);
        auto stepper = make();
        stepper.initialize(x, 0.0, step);
        for (int steps = 0; steps < MOST_STEPS; ++steps) {
            stepper.do_step(system);
            const double end = stepper.current_state()[event];
            if (!(std::abs(end) < LARGEST)) return false;
            if (end > 0.0) continue;
            const double begin = stepper.previous_time(), length = stepper.current_time() - begin;
            stepper.calc_state(begin, x);
            // The step may begin at the event before, where the radius is zero.
            const double at_begin = std::max<double>(x[event], std::numeric_limits<double>::min());
            sign_change({begin, at_begin}, {begin + length, end}, [&](double place) {
                stepper.calc_state(place, x);
                return x[event];
            });
            step = length;
            return true;
        }
        return false;
    }
};

template <class State, class Form, class Make> Dense<State, Form, Make> dense(Make make) { return {make}; }

// A controlled solver without dense output: the step that passes the event is repeated with the length that Newton's method finds.
template <class State> struct Repeated {
    double tolerance;

    bool leg(const Equations &equations, State &x, int event, double &step) const {
        odeint::runge_kutta_fehlberg78<State> plain;
        auto stepper = odeint::make_controlled(tolerance, tolerance, plain);
        double time = 0.0, length = step;
        State before = x, rates = x;
        for (int steps = 0; steps < MOST_STEPS; ++steps) {
            before = x;
            const double begin = time;
            while (stepper.try_step(equations, x, time, length) != odeint::success) {
                if (!(length > 1e-14)) return false;
            }
            if (!(std::abs(x[event]) < LARGEST)) return false;
            if (x[event] > 0.0) continue;
            double low = 0.0, high = time - begin, last = high;
            for (int i = 0; i < 60 && std::abs(x[event]) > 1e-15; ++i) {
                (x[event] > 0.0 ? low : high) = last;
                equations(x, rates, 0.0);
                double next = last - x[event] / rates[event];
                if (!(next > low && next < high)) next = 0.5 * (low + high);
                if (next == last) break;
                last = next;
                x = before;
                plain.do_step(equations, x, 0.0, last);
            }
            step = length;
            return true;
        }
        return false;
    }
};

struct Answer {
    double speed, time, impulse;
};

template <class State, class Solver> Answer solve(const Solver &solver, const Scene &scene, State x) {
    x[SPEED] = scene.speed;
    double step = FIRST_STEP;
    bool solved = true;
    const bool has_two_parts = scene.adhesion * scene.ring_damping != 0.0;
    if (has_two_parts) {
        solved = solver.leg(Equations{scene, false}, x, SPEED, step);
        x[SPEED] = 0.0;
    }
    solved = solved && solver.leg(Equations{scene, true}, x, RADIUS, step);
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    if (!solved) return {nothing, nothing, nothing};
    return x.size() > 2 ? Answer{x[SPEED], x[TIME], x[IMPULSE]} : Answer{x[SPEED], nothing, nothing};
}

template <int S> Answer by(const std::string &method, double tolerance, const Scene &scene) {
    using State = std::array<double, S>;
    if (method == "dopri5") {
        auto make = [=] { return odeint::make_dense_output(tolerance, tolerance, odeint::runge_kutta_dopri5<State>()); };
        return solve(dense<State, Explicit>(make), scene, State{});
    }
    if (method == "fehlberg78") return solve(Repeated<State>{tolerance}, scene, State{});
    using Vector = ublas::vector<double>;
    auto make = [=] { return odeint::make_dense_output(tolerance, tolerance, odeint::rosenbrock4<double>()); };
    return solve(dense<Vector, Implicit>(make), scene, Vector(S, 0.0));
}

Answer by(const std::string &method, double tolerance, bool outputs, const Scene &scene) {
    return outputs ? by<4>(method, tolerance, scene) : by<2>(method, tolerance, scene);
}

} // namespace

int main() {
    std::vector<Scene> scenes;
    std::string command;
    while (std::cin >> command) {
        if (command == "version") {
            std::printf("%d.%d\n", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000);
        } else if (command == "scenes") {
            std::size_t count = 0;
            std::cin >> count;
            scenes.resize(count);
            for (Scene &one : scenes) std::cin >> one.elastic >> one.adhesion >> one.damping >> one.ring_damping >> one.speed;
            const bool stiff = std::any_of(scenes.begin(), scenes.end(), [](const Scene &one) { return one.damping > STIFF; });
            std::puts(stiff ? "dopri5 fehlberg78 rosenbrock4" : "dopri5 fehlberg78");
        } else {
            std::string method;
            double tolerance = 0.0;
            int outputs = 0;
            std::cin >> method >> tolerance >> outputs;
            if (command == "solve") {
                for (const Scene &one : scenes) {
                    const Answer answer = by(method, tolerance, outputs != 0, one);
                    std::printf("%.17g %.17g %.17g\n", answer.speed, answer.time, answer.impulse);
                }
            } else {
                // Time of one pass over all scenes, and what of it is not the solver's: nothing here.
                int repeats = 1;
                std::cin >> repeats;
                double sum = 0.0;
                const auto begin = std::chrono::steady_clock::now();
                for (int i = 0; i < repeats; ++i) {
                    for (const Scene &one : scenes) sum += by(method, tolerance, outputs != 0, one).speed;
                }
                const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
                // The sum is used, so that no compiler leaves out the work.
                std::printf("%.9g 0\n", sum == 0.5 ? 0.0 : elapsed.count() / repeats);
            }
        }
        std::fflush(stdout);
    }
}
