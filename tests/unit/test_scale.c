/* The border between SI and the model: groups against hand values, latched units, and every refusal by its symbol. */
#include "model/scale.h"

#include "base/fmath.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

static struct scale scale_of(struct params params)
{
    struct scale scale = {0};

    (void)tap_check(scale_derive(&params, NULL, &scale).error == ERROR_OK, "the set is served");
    return scale;
}

static void close_to(float actual, float expected, const char *claim)
{
    (void)tap_check_close(actual, expected, 2e-6f * fmath_abs(expected), claim);
}

/* Hand values: impedance sqrt(m ke) = 0.54772256 N s/m, largest load 4 N, largest speed 4 m/s. */
static void check_table1(void)
{
    const struct scale scale = scale_of(plants_params(""));

    close_to(scale.omega_rad_per_s, 1.8257419f, "Table 1: wn");
    close_to(scale.load_n, 4.0f, "Table 1: four times the load");
    close_to(scale.speed_m_per_s, 4.0f, "Table 1: four times the speed");
    close_to(scale.length_m, 2.1908902f, "Table 1: unit of length");
    close_to(scale.normal_m, 4.0f, "Table 1: unit of normal displacement");
    close_to(scale.force_n, 2.1908902f, "Table 1: unit of tangential force");
    close_to(scale.damping, 0.018257419f, "Table 1: C");
    close_to(scale.stiffness, 2.0f, "Table 1: Z2");
    close_to(scale.friction, 0.54772256f, "Table 1: mu");
    close_to(scale.friction_slope, -0.014605935f, "Table 1: eps");
    tap_check(scale.normal_damping == 0.0f && !scale.has_floor && scale.length_shift == 0u, "Table 1: nothing else");
    tap_check(scale.steps_per_period == 64u, "Table 1: 64 steps a period");
    close_to(scale.step, 0.09817477f, "Table 1: h");
    close_to(scale.step_s, 0.05377254f, "Table 1: h in seconds");
}

/* Hand values: impedance 5477.2256 N s/m, largest load 12000 N and speed 2 m/s as the preset says. */
static void check_brake(void)
{
    const struct scale scale = scale_of(plants_preset("brake", "spp 128"));

    close_to(scale.omega_rad_per_s, 18257.419f, "brake: wn");
    close_to(scale.speed_m_per_s, 2.0f, "brake: unit of speed");
    close_to(scale.length_m, 1.0954451e-4f, "brake: unit of length");
    close_to(scale.normal_m, 1.2e-4f, "brake: unit of normal displacement");
    close_to(scale.damping, 0.021908902f, "brake: C");
    close_to(scale.stiffness, 0.475f, "brake: Z2");
    close_to(scale.friction, 0.46008689f, "brake: mu");
    close_to(scale.friction_slope, -0.13145341f, "brake: eps");
    close_to(scale.friction_floor, 0.39436019f, "brake: floor of mu");
    close_to(scale.normal_damping, 0.039983747f, "brake: Cn");
    tap_check(scale.has_floor && scale.steps_per_period == 128u, "brake: floor and steps");
}

static void check_units(void)
{
    struct params params = plants_params("N0 1 N1 3 load step v0 -2 v1 1 speed ramp");
    struct scale scale = scale_of(params);

    tap_check(scale.load_n == 12.0f && scale.speed_m_per_s == 8.0f, "the profile's largest load and speed count");
    params = plants_params("N0 1 N1 3 load sine");
    tap_check(scale_load_peak_n(&params) == 4.0f, "a sine adds its amplitude");
    params = plants_params("N0 1 N1 3 v1 9");
    tap_check(scale_load_peak_n(&params) == 1.0f && scale_speed_peak_m_per_s(&params) == 1.0f,
              "what a constant profile does not use does not count");
    params = plants_params("N0 1 N1 3 load pulses N_off 0.5 dither 0.25 v0 1 speed sine v1 -2 v_off 0.5 v_high 2.5");
    tap_check(scale_load_peak_n(&params) == 3.75f && scale_speed_peak_m_per_s(&params) == 2.5f,
              "offset and dither count, and so do the limits");
    params = plants_params("load table speed table v_off 1");
    params.tables[PARAMS_TABLE_LOAD] = (struct params_points){3u, {{0.0f, 1.0f}, {1.0f, 7.0f}, {2.0f, 0.0f}}};
    params.tables[PARAMS_TABLE_SPEED] = (struct params_points){3u, {{0.0f, 1.0f}, {1.0f, -5.0f}, {2.0f, 0.0f}}};
    tap_check(scale_load_peak_n(&params) == 7.0f && scale_speed_peak_m_per_s(&params) == 4.0f,
              "of a table the largest point");
    scale = scale_of(plants_params("N_max 50 v_max 20"));
    tap_check(scale.load_n == 50.0f && fmath_abs(scale.speed_m_per_s - 27.386128f) < 1e-4f,
              "given limits are taken, the unit of speed covers friction's too");
    scale = scale_of(plants_params("N0 0"));
    tap_check(scale.load_n == 1.0f && scale.speed_m_per_s == 4.0f, "without load any unit of load will do");
    scale = scale_of(plants_params("kt 0.05 k 0"));
    tap_check(scale.length_shift == 3u, "a soft spring shifts x so that it fits");
}

static void check_latched(void)
{
    const struct scale latched = scale_of(plants_params(""));
    struct params params = plants_params("N0 2 v0 3 mu_s 0.5 alpha -0.004 c 0.02 kt 2");
    struct scale scale;

    (void)tap_check(scale_derive(&params, &latched, &scale).error == ERROR_OK, "a live change is served");
    tap_check(scale.load_n == latched.load_n && scale.speed_m_per_s == latched.speed_m_per_s &&
                  scale.length_m == latched.length_m && scale.normal_m == latched.normal_m &&
                  scale.step_s == latched.step_s,
              "and keeps every unit to the bit");
    close_to(scale.friction, 0.91287093f, "mu moves in them");
    close_to(scale.friction_slope, -0.029211870f, "so does eps");
    close_to(scale.damping, 0.036514837f, "so does C");
    close_to(scale.stiffness, 3.0f, "so does Z2");
}

static bool refuses(const char *assignments, const struct scale *latched, enum error error, const char *symbol)
{
    struct params params = plants_params(assignments);
    struct scale scale;
    const struct params_problem problem = scale_derive(&params, latched, &scale);
    size_t length = 0u;
    bool ok;

    while (symbol != NULL && symbol[length] != '\0') {
        length++;
    }
    ok = problem.error == error && problem.info == (symbol == NULL ? NULL : params_find(symbol, length));
    if (!ok) {
        tap_note(assignments);
        tap_note(error_name(problem.error));
        tap_note(problem.info == NULL ? "" : problem.info->symbol);
    }
    return ok;
}

static bool serves(const char *assignments) { return refuses(assignments, NULL, ERROR_OK, NULL); }

static void check_refusals(void)
{
    const struct scale latched = scale_of(plants_params("mu_s 0.1"));

    tap_check(refuses("m -1", NULL, ERROR_OUT_OF_RANGE, "m"), "a single parameter out of range");
    tap_check(refuses("load ramp t1 2 t2 1", NULL, ERROR_OUT_OF_RANGE, "t2") && serves("load ramp t1 2 t2 2") &&
                  serves("load step t1 2 t2 1"),
              "a load that ends before it starts");
    tap_check(refuses("speed ramp tv1 2 tv2 1", NULL, ERROR_OUT_OF_RANGE, "tv2") && serves("speed step tv1 2"),
              "a speed that ends before it starts");
    tap_check(refuses("method naive normal exact", NULL, ERROR_NOT_SERVED, "method") && serves("method naive"),
              "the naive method with a closed form");
    tap_check(refuses("N0 5 N_max 4", NULL, ERROR_OUT_OF_SCALE, "N0") && serves("N0 5 N_max 5"),
              "a load beyond the given limit");
    tap_check(refuses("N0 4.1", &latched, ERROR_OUT_OF_SCALE, "N0") &&
                  refuses("load step N1 4.1", &latched, ERROR_OUT_OF_SCALE, "N1") &&
                  refuses("load sine N0 3 N1 1.1", &latched, ERROR_OUT_OF_SCALE, "N_max") &&
                  refuses("N0 4", &latched, ERROR_OK, NULL),
              "a load beyond the latched one");
    tap_check(refuses("v0 5 v_max 4", NULL, ERROR_OUT_OF_SCALE, "v0") &&
                  refuses("v0 -5 v_max 4", NULL, ERROR_OUT_OF_SCALE, "v0") &&
                  refuses("v0 4.1", &latched, ERROR_OUT_OF_SCALE, "v0") && refuses("v0 -4", &latched, ERROR_OK, NULL),
              "a speed beyond the given or the latched limit");
    tap_check(refuses("kt 7.5 k 7.51", NULL, ERROR_OUT_OF_SCALE, "kt") && serves("kt 7.5 k 7.5"),
              "springs beyond Z2 = 15, which itself is served");
    tap_check(refuses("mu_s 5", &latched, ERROR_OUT_OF_SCALE, "mu_s") && refuses("mu_s 4.3", &latched, ERROR_OK, NULL),
              "friction beyond 8 of the latched unit");
    tap_check(refuses("alpha -1.2", NULL, ERROR_OUT_OF_SCALE, "alpha") &&
                  refuses("alpha 1.2", NULL, ERROR_OUT_OF_SCALE, "alpha") && serves("alpha -1.09"),
              "a slope beyond 8");
    tap_check(refuses("x0 9000", NULL, ERROR_OUT_OF_SCALE, "x0") && serves("x0 -8900") &&
                  refuses("xd0 -16385", NULL, ERROR_OUT_OF_SCALE, "xd0") && serves("xd0 16384") &&
                  refuses("y0 257", NULL, ERROR_OUT_OF_SCALE, "y0") && serves("y0 -256") &&
                  refuses("yd0 -470", NULL, ERROR_OUT_OF_SCALE, "yd0") && serves("yd0 467"),
              "a start outside the domain");
    tap_check(refuses("N0 0 v0 0", NULL, ERROR_NO_SCALE, NULL) && refuses("mu_s 0 v0 0", NULL, ERROR_NO_SCALE, NULL) &&
                  serves("v0 0") && serves("mu_s 0"),
              "neither speed nor friction");
    tap_check(refuses("N0 1e-35 ke 1e3", NULL, ERROR_NO_SCALE, NULL) &&
                  refuses("v0 1e-35 mu_s 0", NULL, ERROR_NO_SCALE, NULL) && serves("N0 1e-20 v0 1e-20"),
              "units too small to divide by");
}

/* z = 2 pi/spp max(1, Z, C, Cn) <= 0.40: at 16 steps Z2 <= 1.03753, at 64 steps C, Cn <= 4.0744 (c <= 2.23163 N
 * s/m). */
static void check_step_limit(void)
{
    tap_check(serves("spp 16 kt 0.5 k 0.5375") && refuses("spp 16 kt 0.5 k 0.5376", NULL, ERROR_STEP_TOO_LARGE, "spp"),
              "the stiffness at z = 0.40");
    tap_check(serves("c 2.2316") && refuses("c 2.2317", NULL, ERROR_STEP_TOO_LARGE, "spp"), "the damping there");
    tap_check(serves("cn 2.2316") && refuses("cn 2.2317", NULL, ERROR_STEP_TOO_LARGE, "spp"),
              "the normal damping there");
    tap_check(serves("spp 16 kt 0 k 0") && refuses("spp 32 kt 3 k 2", NULL, ERROR_STEP_TOO_LARGE, "spp"),
              "no spring is no reason, a stiff one is");
}

void test_scale(void)
{
    const struct scale scale = scale_of(plants_params("spp 16 kt 0.5 k 0.5"));

    check_table1();
    check_brake();
    check_units();
    check_latched();
    check_refusals();
    check_step_limit();
    close_to(scale_rk4_loss_per_period(&scale), 4.0748986e-4f, "RK4 takes 2 pi h^5/144 of y a period");
}
