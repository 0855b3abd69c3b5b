/* Made by tests/oracle/inspiral_reference.py; do not edit. Quadrature of Peters's rates. */
#ifndef KD_TESTS_INSPIRAL_REFERENCE_H
#define KD_TESTS_INSPIRAL_REFERENCE_H

struct inspiral_reference { double eta, a, e, time; };

static const struct inspiral_reference inspiral_reference[] = {
    { 0.25, 100.0, 0.001, 7812471.4753310863 },
    { 0.25, 100.0, 0.1, 7531262.4559733359 },
    { 0.25, 10000.0, 0.5, 279529886880345.21 },
    { 0.2, 1000000.0, 0.9, 3.3271724570889772e+20 },
    { 0.01, 50.0, 0.99, 20.368263962767562 },
    { 0.1, 100000.0, 0.9999, 3911849.5403806574 },
};

#endif
