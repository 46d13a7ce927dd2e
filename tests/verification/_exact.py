"""Numerical solution of the equations that the exact solutions of the verifications come from."""


def runge_kutta(slope, state, times, n_steps=20):
    """States at the given times of d state / dt = slope(state), from that of the first time; fourth order, n_steps
    from one time to the next."""
    states = [list(state)]
    for begin, end in zip(times, times[1:]):
        dt, y = (end - begin) / n_steps, states[-1]
        for _ in range(n_steps):
            k1 = slope(y)
            k2 = slope([a + dt / 2 * b for a, b in zip(y, k1)])
            k3 = slope([a + dt / 2 * b for a, b in zip(y, k2)])
            k4 = slope([a + dt * b for a, b in zip(y, k3)])
            y = [a + dt / 6 * (b + 2 * c + 2 * d + e) for a, b, c, d, e in zip(y, k1, k2, k3, k4)]
        states.append(y)
    return states


def root(function, lower, upper):
    """Where a function changes its sign between two arguments, by bisection."""
    sign = function(lower) > 0
    assert sign != (function(upper) > 0)
    for _ in range(100):
        middle = (lower + upper) / 2
        lower, upper = (middle, upper) if (function(middle) > 0) == sign else (lower, middle)
    return (lower + upper) / 2
