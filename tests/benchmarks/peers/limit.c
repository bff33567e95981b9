/* The limit: the same network, equations and scheme (RK4) in plain C, from a header made of the exported network.
 *
 * Talks like every peer: `run N` steps N times from the initial state and answers the seconds that it took, `trace`
 * answers the reference neuron's potential of the last run (V, every SAMPLING_STEPS steps).
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "network.h"

#define INTERNEURONS RYBAK_INTERNEURONS
#define BURSTERS RYBAK_NEURONS
/* States: potentials of all neurons, interneurons first, then the inactivations of the bursting ones. */
#define STATES (NEURONS + BURSTERS)

static double activity[NEURONS], excitation[NEURONS], inhibition[NEURONS];

static inline double logistic(double x) { return 1.0 / (1.0 + exp(-x)); }

#define OUTPUT(kind, count, first)                                                                        \
    for (int i = 0; i < (count); i++) {                                                                   \
        const double v = x[(first) + i];                                                                  \
        const double f = logistic((v - kind##_half_activity_potential(i)) / kind##_activity_slope(i));    \
        activity[(first) + i] = v < kind##_threshold(i) ? 0.0 : f;                                        \
    }

static void synapses(void)
{
    for (int i = 0; i < NEURONS; i++) {
        double e = excitation_constant[i], n = inhibition_constant[i];
        for (int k = excitation_start[i]; k < excitation_start[i + 1]; k++)
            e += excitation_weight[k] * activity[excitation_sender[k]];
        for (int k = inhibition_start[i]; k < inhibition_start[i + 1]; k++)
            n += inhibition_weight[k] * activity[inhibition_sender[k]];
        excitation[i] = e;
        inhibition[i] = n;
    }
}

static void derivative(const double *restrict x, double *restrict slope)
{
    OUTPUT(rybak_interneuron, INTERNEURONS, 0)
    OUTPUT(rybak_neuron, BURSTERS, INTERNEURONS)
    synapses();
    for (int i = 0; i < INTERNEURONS; i++) {
        const double v = x[i];
        const double ge = rybak_interneuron_excitatory_conductance(i) * excitation[i];
        const double gi = rybak_interneuron_inhibitory_conductance(i) * inhibition[i];
        slope[i] = (rybak_interneuron_leak_conductance(i) * (rybak_interneuron_leak_reversal(i) - v)
                    + ge * (rybak_interneuron_excitatory_reversal(i) - v)
                    + gi * (rybak_interneuron_inhibitory_reversal(i) - v)) / rybak_interneuron_capacitance(i);
    }
    for (int i = 0; i < BURSTERS; i++) {
        const double v = x[INTERNEURONS + i], h = x[NEURONS + i];
        const double m_sodium =
            logistic((v - rybak_neuron_sodium_activation_half(i)) / rybak_neuron_sodium_activation_slope(i));
        const double m_potassium =
            logistic((v - rybak_neuron_potassium_activation_half(i)) / rybak_neuron_potassium_activation_slope(i));
        const double squared = m_potassium * m_potassium;
        const double g_sodium = rybak_neuron_sodium_conductance(i) * m_sodium * h;
        const double g_potassium = rybak_neuron_potassium_conductance(i) * squared * squared;
        const double ge = rybak_neuron_excitatory_conductance(i) * excitation[INTERNEURONS + i];
        const double gi = rybak_neuron_inhibitory_conductance(i) * inhibition[INTERNEURONS + i];
        const double shifted = v - rybak_neuron_sodium_inactivation_half(i);
        const double steady = logistic(-shifted / rybak_neuron_sodium_inactivation_slope(i));
        const double grown = exp(shifted / rybak_neuron_inactivation_time_slope(i));
        const double rate = 0.5 * (grown + 1.0 / grown) / rybak_neuron_maximal_inactivation_time(i);
        slope[INTERNEURONS + i] = (g_sodium * (rybak_neuron_sodium_reversal(i) - v)
                                   + g_potassium * (rybak_neuron_potassium_reversal(i) - v)
                                   + rybak_neuron_leak_conductance(i) * (rybak_neuron_leak_reversal(i) - v)
                                   + ge * (rybak_neuron_excitatory_reversal(i) - v)
                                   + gi * (rybak_neuron_inhibitory_reversal(i) - v)) / rybak_neuron_capacitance(i);
        slope[NEURONS + i] = (steady - h) * rate;
    }
}

static void step(double *restrict x)
{
    static double k1[STATES], k2[STATES], k3[STATES], k4[STATES], y[STATES];
    derivative(x, k1);
    for (int i = 0; i < STATES; i++) y[i] = x[i] + 0.5 * STEP * k1[i];
    derivative(y, k2);
    for (int i = 0; i < STATES; i++) y[i] = x[i] + 0.5 * STEP * k2[i];
    derivative(y, k3);
    for (int i = 0; i < STATES; i++) y[i] = x[i] + STEP * k3[i];
    derivative(y, k4);
    for (int i = 0; i < STATES; i++) x[i] += STEP / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
}

static double run(long steps, double *trace)
{
    static double x[STATES];
    struct timespec start, end;
    memcpy(x, rybak_interneuron_initial_potential, sizeof rybak_interneuron_initial_potential);
    memcpy(x + INTERNEURONS, rybak_neuron_initial_potential, sizeof rybak_neuron_initial_potential);
    memcpy(x + NEURONS, rybak_neuron_initial_inactivation, sizeof rybak_neuron_initial_inactivation);
    clock_gettime(CLOCK_MONOTONIC, &start);
    for (long n = 0; n < steps; n++) {
        if (n % SAMPLING_STEPS == 0) trace[n / SAMPLING_STEPS] = x[REFERENCE];
        step(x);
    }
    clock_gettime(CLOCK_MONOTONIC, &end);
    return (double)(end.tv_sec - start.tv_sec) + 1e-9 * (double)(end.tv_nsec - start.tv_nsec);
}

int main(void)
{
    char line[64];
    double *trace = NULL;
    long steps = 0;
    printf("{\"name\": \"C\", \"version\": \"%s\", \"scheme\": \"RK4\"}\n", __VERSION__);
    fflush(stdout);
    while (fgets(line, sizeof line, stdin)) {
        if (sscanf(line, "run %ld", &steps) == 1) {
            trace = realloc(trace, (size_t)(steps / SAMPLING_STEPS + 1) * sizeof *trace);
            if (!trace) return 1;
            printf("%.9g\n", run(steps, trace));
        } else {
            for (long n = 0; n < (steps + SAMPLING_STEPS - 1) / SAMPLING_STEPS; n++)
                printf("%s%.9g", n ? ", " : "[", trace[n]);
            printf("]\n");
        }
        fflush(stdout);
    }
    free(trace);
    return 0;
}
