/* Complex numbers of two floats, for closed forms: a + bi stands for a cos + b sin of some phase. [ANY, pure] */
#ifndef BASE_COMPLEX32_H
#define BASE_COMPLEX32_H

struct complex32 {
    float re, im;
};

static inline struct complex32 complex32_times(struct complex32 a, struct complex32 b)
{
    return (struct complex32){a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

static inline struct complex32 complex32_scaled(struct complex32 a, float factor)
{
    return (struct complex32){a.re * factor, a.im * factor};
}

static inline struct complex32 complex32_plus(struct complex32 a, struct complex32 b)
{
    return (struct complex32){a.re + b.re, a.im + b.im};
}

static inline struct complex32 complex32_conjugate(struct complex32 a) { return (struct complex32){a.re, -a.im}; }

static inline float complex32_square(struct complex32 a) { return a.re * a.re + a.im * a.im; }

/* 1/a; a must not be 0. */
static inline struct complex32 complex32_inverse(struct complex32 a)
{
    return complex32_scaled(complex32_conjugate(a), 1.0f / complex32_square(a));
}

#endif
