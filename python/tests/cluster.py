"""What the workers of a cluster import: scenes by name."""

import os
import signal
import time
from pathlib import Path

import signorini as sg


def make(gap: float, restitution: float = 0.8) -> sg.Scene:
    """The source scene with another gap; a negative one is refused."""
    walls = sg.support("stop", gap, restitution=restitution)
    return sg.oscillator(1.0, 0.2, 100.0, walls=walls, loads=[sg.Load.harmonic(3.0, 5.0)], duration=4.0)


def deadly(gap: float, flag: str, restitution: float = 0.8) -> sg.Scene:
    """The same; the first worker other than the test itself that gets here kills itself, once."""
    if os.getpid() != int(os.environ.get("SIGNORINI_TEST_PID", "0")) and gap > 5e-3:
        try:
            Path(flag).touch(exist_ok=False)
        except FileExistsError:
            pass
        else:
            time.sleep(0.1)
            os.kill(os.getpid(), signal.SIGKILL)
    return make(gap, restitution)
