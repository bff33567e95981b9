"""What records, as text of a generated step module. <name> is an offset or a count."""

RECORD = '''
@part
def mean(k, x, s, u, I):
    """Return the k-th mean over a population."""
    first, count = I[<mean_first> + k], I[<mean_count> + k]
    states, signals = x.shape[0], s.shape[0]
    if first < states:
        return np.sum(x[first : first + count]) / count
    if first < states + signals:
        return np.sum(s[first - states : first - states + count]) / count
    return np.sum(u[first - states - signals : first - states - signals + count]) / count


@part
def is_due(tick, I):
    """Return whether any record group samples this tick."""
    for group in range(<groups>):
        if tick % I[<group_every> + group] == 0:
            return True
    return False


@part
def record(tick, x, s, u, I, R):
    """Copy the signals of every record group that is due, one stretch of signals that stand in one array at a time."""
    for group in range(<groups>):
        every = I[<group_every> + group]
        if tick % every:
            continue
        start, end = I[<group_start> + group], I[<group_start> + group + 1]
        row = I[<group_row> + group] + (tick // every) * (end - start) - start
        for k in range(I[<group_stretch> + group], I[<group_stretch> + group + 1]):
            first, last = I[<stretch_start> + k], I[<stretch_start> + k + 1]
            place = places_of(I, <place> + first, last - first)
            samples = span_of(R, row + first, last - first)
            array = I[<stretch_array> + k]
            if array == 0:
                copy_from(x, place, samples)
            elif array == 1:
                copy_from(s, place, samples)
            elif array == 2:
                copy_from(u, place, samples)
            else:
                for h in range(last - first):
                    samples[h] = mean(I[<place> + first + h], x, s, u, I)
'''
