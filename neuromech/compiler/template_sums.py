"""What sums signals into input ports, as text of a generated step module. <name> is an offset or a count."""

ROWS = '''
@part
def arriving(row, s, p, F, I, source, row_start, weights, base):
    """Return the sum of the weighted signals that reach an input port."""
    total = F[base + row] + weighted_sum_at(p, s, source, weights, I[row_start + row], I[row_start + row + 1])
    if <shared weights>:
        shared_source = I[<segment_source> :].view(np.uint32)
        for g in range(I[<segment_start> + row], I[<segment_start> + row + 1]):
            some = shared_source[I[<segment_first> + g] : I[<segment_last> + g]]
            total += p[weights + I[<segment_weight> + g]] * sum_at(s, some)
    return total


@part
def rows_between(s, u, p, F, I, first, last):
    """Sum the weighted signals that reach the input ports from `first` to `last`."""
    source = I[<row_source> :].view(np.uint32)
    row_start, weights, base = <row_start>, <weights>, <base>
    for row in range(first, last):
        u[row] = arriving(row, s, p, F, I, source, row_start, weights, base)
'''

GATHER = '''
@part
def gather(s, u, p, F, I, first, rows, stride, ports):
    """Sum the weighted signals that reach `ports` blocks of `rows` input ports each."""
    for port in range(ports):
        start = first + port * stride
        rows_between(s, u, p, F, I, start, start + rows)
'''

TEAM_GATHER = '''
@part
def take_rows(s, u, p, F, I):
    """Sum rows of the present order until none are left."""
    team = I.ctypes.data + 8 * <team>
    first, last = I[<team> + FIRST], I[<team> + LAST]
    while True:
        start = first + PART * add(team + 8 * NEXT, 1)
        if start >= last:
            return
        rows_between(s, u, p, F, I, start, min(start + PART, last))


@compiled
def help(s, u, p, F, I):
    """Help the thread that runs the step until it stops the team."""
    team = I.ctypes.data + 8 * <team>
    seen, turns = 0, 0
    while True:
        order = load(team + 8 * ORDER)
        if order == STOP:
            return
        if order == seen:
            turns = rest_now_and_then(turns)
            continue
        seen = order
        take_rows(s, u, p, F, I)
        add(team + 8 * DONE, 1)


@part
def gather(s, u, p, F, I, first, rows, stride, ports):
    """Sum the weighted signals that reach `ports` blocks of `rows` input ports each, many of them with the team."""
    helpers = I[<team> + HELPERS]
    for port in range(ports):
        start = first + port * stride
        if helpers == 0 or rows <= PART:
            rows_between(s, u, p, F, I, start, start + rows)
            continue
        team = I.ctypes.data + 8 * <team>
        I[<team> + FIRST], I[<team> + LAST] = start, start + rows
        store(team + 8 * NEXT, 0)
        store(team + 8 * DONE, 0)
        add(team + 8 * ORDER, 1)
        take_rows(s, u, p, F, I)
        turns = 0
        while load(team + 8 * DONE) < helpers:
            turns = rest_now_and_then(turns)


@compiled
def stop(I):
    """Send the team away."""
    store(I.ctypes.data + 8 * <team> + 8 * ORDER, STOP)
'''

GATHER_SLOTS = '''
@part
def gather_slots(s, u, p, F, I, first, rows, table):
    """Sum the weighted signals that reach `rows` input ports, the k-th of every port at a time; see `slots.py`."""
    used, slots, entry, row = I[table], I[table + 1], I[table + 2], I[table + 3]
    base = span_of(F, <base> + first, rows)
    ports = span_of(u, first, rows)
    for k in range(rows):
        ports[k] = base[k]
    total = span_of(F, <slot_sums>, used)
    for k in range(used):
        total[k] = 0.0
    for slot in range(slots):
        count = I[table + 4 + slot]
        source = places_of(I, <slot_source> + entry, count)
        weight = span_of(p, <slot_weights> + entry, count)
        for k in range(count):
            total[k] += weight[k] * s[source[k]]
        entry += count
    order = places_of(I, <slot_order> + row, used)
    for k in range(used):
        u[order[k]] += total[k]
'''
