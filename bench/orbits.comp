// Yoshida's step of src/physics/orbit/orbit_path.c, in double precision, without compensated sums. Each invocation
// integrates one orbit. bench/orbits_device.c uses this kernel to measure the cost of lists of orbits.
#version 450
layout(local_size_x = 64) in;

struct Orbit {
    double a, energy, momentum, z, binding, w_low, w_high, g0, g1, g2, c0, c1, c2, c3, c4, by_energy;
    double cc_twist, nu, stiff, strength_w, centre_w, h;
    double w, w_rate, y, y_rate, proper, t, chi, drift;
    double kick_w[4], drift_w[4], kick_y[4], drift_y[4];
};
layout(std430, set = 0, binding = 0) buffer Orbits { Orbit orbits[]; };
layout(push_constant) uniform Push { uint n, steps; };

const double kicks[7] =
    double[](0.7845136104775572lf, 0.23557321335935813lf, -1.177679984178871lf, 1.3151863206839112lf,
             -1.177679984178871lf, 0.23557321335935813lf, 0.7845136104775572lf);

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= n)
        return;
    Orbit o = orbits[i];
    double a2 = o.a * o.a, worst = 0.0lf, bend = a2 * o.binding;
    double w = o.w, v = o.w_rate, y = o.y, u = o.y_rate, proper = 0.0lf, t = 0.0lf, chi = 0.0lf;
    for (uint k = 0; k < steps; k++) {
        for (int stage = 0; stage < 8; stage++) {
            int which = stage < 4 ? stage : 7 - stage;
            v += o.kick_w[which] * (w - o.centre_w);
            w += o.drift_w[which] * v;
            v += o.kick_w[which] * (w - o.centre_w);
            u += o.kick_y[which] * y;
            y += o.drift_y[which] * u;
            u += o.kick_y[which] * y;
            if (stage == 7)
                break;
            double w2 = w * w, a2w2 = a2 * w2, y2 = y * y, up = a2 * o.z * y2;
            double far = 1.0lf / w2, hole = 1.0lf / (1.0lf - 2.0lf * w + a2w2);
            double left = w - o.w_low, right = o.w_high - w, g = o.g0 + w * (o.g1 + w * o.g2),
                   slope = o.g1 + 2.0lf * w * o.g2;
            double kick = kicks[stage] * o.h;
            v += kick * (0.5lf * ((right - left) * g + left * right * slope) + o.strength_w * (w - o.centre_w));
            u += kick * y * (2.0lf * bend * o.z * y2 + o.stiff);
            proper += kick * (far + up);
            chi += kick * (o.cc_twist * (1.0lf - y2) / (1.0lf - o.nu * y2) +
                           o.a * (2.0lf * o.energy * w - o.a * o.momentum * w2) * hole);
            t += kick * (o.energy * (far + 2.0lf * w * far + 4.0lf + up) +
                         ((8.0lf * o.energy - 2.0lf * o.a * o.momentum) * w - 4.0lf * a2w2 * o.energy) * hole);
        }
        double radial = v * v - (o.c0 + w * (o.c1 + w * (o.c2 + w * (o.c3 + w * o.c4))));
        worst = max(worst, abs(radial));
    }
    orbits[i].w = w, orbits[i].w_rate = v, orbits[i].y = y, orbits[i].y_rate = u;
    orbits[i].proper = proper, orbits[i].t = t, orbits[i].chi = chi, orbits[i].drift = worst;
}
