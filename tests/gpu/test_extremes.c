/* Tests of stability at the extremes: spins from 0 to 1 - 1e-12; observers on the axis, in the plane, and an ulp beside
 * axis and plane; observers next to the horizon and a million M away; rays 1e-12 from the critical curve; up to eight
 * orders; pictures of one pixel and of odd shapes; denormal numbers. Prints a row for each case and engine; any failing
 * row fails the test. Every number must be finite, and every error within the stated bound, unless the answer marks the
 * ray as
 * inaccurate. */
#include "extremes.h"

#include "render_support.h"

int main(void)
{
    int status = open_renderer();
    if (status)
        return status;
    size_t broken;
    extreme_closed();
    extreme_rays(renderer);
    extreme_lenses(renderer);
    extreme_pictures(renderer);
    size_t rows = extreme_rows(&broken);
    printf("%zu rows, %zu broken\n", rows, broken);
    return close_renderer(broken > 0);
}
