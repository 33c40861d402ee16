"""The stick-slip pad of the bench by a reference: y in closed form, x by RK4 of many steps in double precision, with the sign of
the slip speed frozen, and switches bisected. None of the firmware's code."""
import math

MASS, DAMPING, SPRING, FRICTION, SLOPE, DISC, LOAD = 0.3, 0.01, 2.0, 0.3, -0.02, 1.0, 10.0
OMEGA = math.sqrt(1.0 / MASS)
SLIP_PLUS, STICK, SLIP_MINUS = 1, 0, -1


def force(t):
    return LOAD * (1.0 - math.cos(OMEGA * t))


def rates(t, x, v, side):
    mu = FRICTION + SLOPE * side * (DISC - v)
    return v, (side * mu * force(t) - DAMPING * v - SPRING * x) / MASS


def advance(t, x, v, side, h):
    if side == STICK:
        return x + h * DISC, DISC
    k1 = rates(t, x, v, side)
    k2 = rates(t + h / 2, x + h / 2 * k1[0], v + h / 2 * k1[1], side)
    k3 = rates(t + h / 2, x + h / 2 * k2[0], v + h / 2 * k2[1], side)
    k4 = rates(t + h, x + h * k3[0], v + h * k3[1], side)
    return (x + h / 6 * (k1[0] + 2 * k2[0] + 2 * k3[0] + k4[0]), v + h / 6 * (k1[1] + 2 * k2[1] + 2 * k3[1] + k4[1]))


def spare(t, x, v, side):
    """Positive while the regime lasts."""
    return side * (DISC - v) if side else FRICTION * force(t) - abs(DAMPING * DISC + SPRING * x)


def next_regime(t, x, side):
    need = DAMPING * DISC + SPRING * x
    if side != STICK and abs(need) <= FRICTION * force(t):
        return STICK
    return SLIP_PLUS if need > 0 else SLIP_MINUS


def displacement_after(periods, steps=2048):
    h = 2.0 * math.pi / OMEGA / steps
    t, x, v, side = 0.0, 0.0, 0.0, SLIP_PLUS
    for step in range(periods * steps):
        end = (step + 1) * h
        while end - t > 1e-15:
            rest = end - t
            x_end, v_end = advance(t, x, v, side, rest)
            if spare(end, x_end, v_end, side) >= 0.0:
                t, x, v = end, x_end, v_end
                break
            low, high = 0.0, rest
            for _ in range(50):
                middle = (low + high) / 2
                if spare(t + middle, *advance(t, x, v, side, middle), side) >= 0.0:
                    low = middle
                else:
                    high = middle
            x, v = advance(t, x, v, side, high)
            t, v = t + high, DISC
            side = next_regime(t, x, side)
    return x
