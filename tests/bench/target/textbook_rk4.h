/* The text of textbook.c for one number format: REAL, and NAME() that joins a name to it. Included once for each. */

static struct {
    REAL mass, damping, normal, spring, friction, slope, disc, load;
} NAME(pad);

typedef void (*NAME(rates))(REAL time, const REAL *state, REAL *rate);

static REAL NAME(sign)(REAL value) { return value > 0 ? (REAL)1 : value < 0 ? (REAL)-1 : (REAL)0; }

static void NAME(equation_20)(REAL time, const REAL *state, REAL *rate)
{
    const REAL vr = NAME(pad).disc - state[1];
    const REAL side = NAME(sign)(vr);

    (void)time;
    rate[0] = state[1];
    rate[1] = -NAME(pad).damping / NAME(pad).mass * state[1] - NAME(pad).spring / NAME(pad).mass * state[0] +
              (NAME(pad).friction + NAME(pad).slope * vr * side) * NAME(pad).normal * state[2] * side / NAME(pad).mass;
    rate[2] = state[3];
    rate[3] = -NAME(pad).normal / NAME(pad).mass * state[2] + NAME(pad).load / NAME(pad).mass;
}

/* Neither inlined nor unrolled: it comes from a library, and knows neither the equation nor how many states it has. */
static BASE_NOINLINE void NAME(runge_kutta)(NAME(rates) rates, REAL time, REAL step, REAL *state, int count)
{
    REAL k1[4], k2[4], k3[4], k4[4], at[4];

    rates(time, state, k1);
    for (int i = 0; i < count; i++) {
        at[i] = state[i] + step / 2 * k1[i];
    }
    rates(time + step / 2, at, k2);
    for (int i = 0; i < count; i++) {
        at[i] = state[i] + step / 2 * k2[i];
    }
    rates(time + step / 2, at, k3);
    for (int i = 0; i < count; i++) {
        at[i] = state[i] + step * k3[i];
    }
    rates(time + step, at, k4);
    for (int i = 0; i < count; i++) {
        state[i] += step / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    }
}

static const volatile NAME(rates) NAME(chosen) = NAME(equation_20);
static volatile int NAME(states) = 4;

void NAME(textbook_start)(struct NAME(textbook) * pad, float load_n, float slope_s_per_m, float step_s)
{
    NAME(pad).mass = (REAL)0.3;
    NAME(pad).damping = (REAL)0.01;
    NAME(pad).normal = 1;
    NAME(pad).spring = 2; /* k + kt */
    NAME(pad).friction = (REAL)0.3;
    NAME(pad).slope = slope_s_per_m;
    NAME(pad).disc = 1;
    NAME(pad).load = load_n;
    *pad = (struct NAME(textbook)){.step_s = step_s};
}

void NAME(textbook_step)(struct NAME(textbook) * pad)
{
    NAME(runge_kutta)(NAME(chosen), pad->time_s, pad->step_s, pad->state, NAME(states));
    pad->time_s += pad->step_s;
}
