#include "extremes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static size_t rows, broken_rows;

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void extreme_spread(double *errors, size_t n, struct extreme_row *row)
{
    row->median = row->most = row->worst = NAN;
    if (!n)
        return;
    qsort(errors, n, sizeof *errors, by_value);
    row->median = errors[n / 2];
    row->most = errors[(n * 99) / 100];
    row->worst = errors[n - 1];
}

static void number(double x)
{
    if (isnan(x))
        printf("  %7s", "-");
    else
        printf("  %7.1e", x);
}

static bool holds(const struct extreme_row *r)
{
    return !r->broken && !(r->worst > r->bound) && !(r->phi > r->phi_bound) && r->loose <= r->rays / 100 &&
           (double)r->unsure <= r->unsure_most * (double)r->rays;
}

void extreme_row(const struct extreme_row *r)
{
    if (!rows++)
        printf("%-34s  %-13s  %6s  %7s  %7s  %7s  %7s  %7s  %7s  %6s  %5s  %6s\n", "case", "engine", "rays", "r: med",
               "99 %", "worst", "bound", "phi", "bound", "unsure", "loose", "broken");
    broken_rows += !holds(r);
    printf("%-34s  %-13s  %6zu", r->what, r->engine, r->rays);
    number(r->median);
    number(r->most);
    number(r->worst);
    number(r->bound);
    number(r->phi);
    number(r->phi_bound);
    printf("  %6zu  %5zu  %6zu  %s\n", r->unsure, r->loose, r->broken, holds(r) ? "ok" : "BREAKS");
    fflush(stdout);
}

size_t extreme_rows(size_t *broken)
{
    *broken = broken_rows;
    return rows;
}
