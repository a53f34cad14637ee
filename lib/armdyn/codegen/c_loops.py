"""Holds the C of the loops over many states and over the steps of RK4."""

SOURCE = """
/* Row by row to lane by lane; lanes that no row fills repeat the last one. */
INLINE void gather(int used, int width, const double *restrict rows, ptrdiff_t step,
                   double *restrict to)
{
    /* With every number known, compilers turn the loop into shuffles of whole vectors. */
    if (used == LANES && step == width)
        for (int l = 0; l < LANES; l++)
            for (int i = 0; i < width; i++)
                to[i * LANES + l] = rows[l * width + i];
    else {
        for (int l = 0; l < used; l++)
            for (int i = 0; i < width; i++)
                to[i * LANES + l] = rows[l * step + i];
        for (int l = used; l < LANES; l++)
            for (int i = 0; i < width; i++)
                to[i * LANES + l] = rows[(used - 1) * step + i];
    }
}

/* The first `used` lanes of x, back to rows. */
INLINE void scatter(int lanes, int used, int width, const double *restrict x, ptrdiff_t step,
                    double *restrict rows)
{
    if (used == LANES && lanes == LANES && step == width)
        for (int l = 0; l < LANES; l++)
            for (int i = 0; i < width; i++)
                rows[l * width + i] = x[i * LANES + l];
    else
        for (int l = 0; l < used; l++)
            for (int i = 0; i < width; i++)
                rows[l * step + i] = x[i * lanes + l];
}

static ptrdiff_t many(const double *k, double least, ptrdiff_t count, const double *q, ptrdiff_t q_step,
               const double *v, ptrdiff_t v_step, const double *u, ptrdiff_t u_step, double *a)
{
    ALIGNED double state[3 * N * LANES], al[N * LANES];
    double *ql = state, *vl = state + N * LANES, *ul = state + 2 * N * LANES;
    for (ptrdiff_t first = 0; first < count; first += LANES) {
        const int used = count - first < LANES ? (int)(count - first) : LANES;
        gather(used, N, q + first * q_step, q_step, ql);
        gather(used, N, v + first * v_step, v_step, vl);
        gather(used, N, u + first * u_step, u_step, ul);
        if (!(forward(LANES, k, least, ql, vl, ul, al) & all_finite(3 * N * LANES, state)))
            for (int l = 0; l < used; l++) {
                const ptrdiff_t row = first + l;
                if (!one(k, least, q + row * q_step, v + row * v_step, u + row * u_step, al))
                    return row;
            }
        scatter(LANES, used, N, al, N, a + first * N);
    }
    return -1;
}

/* A stage's slope is (its velocity, its acceleration), so only accelerations need a place, and the
   weighted sum of the velocities comes from them: v, v + dt/2 a1, v + dt/2 a2, v + dt a3. */
INLINE ptrdiff_t rk4_block(const int lanes, int used, const double *k, double least,
                           double *restrict x, const double *restrict u, double dt,
                           ptrdiff_t steps, int keep, double *restrict to)
{
    enum { SIZE = N * LANES };
    ALIGNED double q[SIZE], v[SIZE], a[4 * SIZE];
    double *a1 = a, *a2 = a + SIZE, *a3 = a + 2 * SIZE, *a4 = a + 3 * SIZE;
    const ptrdiff_t step = keep ? (steps + 1) * 2 * N : 2 * N;
    const int half = N * lanes;
    const double sixth = dt / 6;
    if (keep)
        scatter(lanes, used, 2 * N, x, step, to);
    for (ptrdiff_t t = 0; t < steps; t++) {
        int regular = forward(lanes, k, least, x, x + half, u, a1);
        for (int i = 0; i < half; i++) {
            q[i] = x[i] + dt / 2 * x[half + i];
            v[i] = x[half + i] + dt / 2 * a1[i];
        }
        for (int stage = 1; stage < 4; stage++) {
            const double reach = stage == 1 ? dt / 2 : dt;
            double *now = a + stage * SIZE;
            regular &= forward(lanes, k, least, q, v, u, now);
            for (int i = 0; i < half; i++) {
                q[i] = x[i] + reach * v[i];
                v[i] = x[half + i] + reach * now[i];
            }
        }
        for (int i = 0; i < half; i++) {
            x[i] += dt * (x[half + i] + sixth * (a1[i] + a2[i] + a3[i]));
            x[half + i] += sixth * (a1[i] + a4[i] + 2 * (a2[i] + a3[i]));
        }
        if (!(regular & all_finite(2 * half, x)))
            return t + 1;
        if (keep)
            scatter(lanes, used, 2 * N, x, step, to + (t + 1) * 2 * N);
    }
    if (!keep)
        scatter(lanes, used, 2 * N, x, step, to);
    return -1;
}

static ptrdiff_t rk4(const double *k, double least, ptrdiff_t arms, const double *x0, ptrdiff_t x_step,
              const double *u, ptrdiff_t u_step, double dt, ptrdiff_t steps, int keep, double *x)
{
    ALIGNED double xl[2 * N * LANES], ul[N * LANES];
    const ptrdiff_t row = keep ? (steps + 1) * 2 * N : 2 * N;
    for (ptrdiff_t first = 0; first < arms; first += LANES) {
        const int used = arms - first < LANES ? (int)(arms - first) : LANES;
        ptrdiff_t stopped = -1;
        if (used >= LANES / 4) {
            gather(used, 2 * N, x0 + first * x_step, x_step, xl);
            gather(used, N, u + first * u_step, u_step, ul);
            stopped = rk4_block(LANES, used, k, least, xl, ul, dt, steps, keep, x + first * row);
            if (stopped < 0)
                continue;
        }
        for (ptrdiff_t arm = first; arm < first + used; arm++) {
            for (int i = 0; i < 2 * N; i++)
                xl[i] = x0[arm * x_step + i];
            stopped = rk4_block(1, 1, k, least, xl, u + arm * u_step, dt, steps, keep,
                                x + arm * row);
            if (stopped >= 0)
                return arm * (steps + 1) + stopped;
        }
    }
    return -1;
}
"""
