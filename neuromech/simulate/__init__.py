"""Time: the loop, the clocks, schedules, recording and outcome."""
