"""What is asked of a cycle count."""

import time
from typing import NamedTuple


class Request(NamedTuple):
    """Count from the wear `start` (mm), which has no meaning beyond `limit` (mm), over `cycles` at
    least, to the relative error `rtol`; and refine nothing any more after `deadline`
    (`time.monotonic()`)."""

    cycles: float
    rtol: float
    start: float
    limit: float
    deadline: float

    @property
    def late(self) -> bool:
        """Whether the deadline has passed."""
        return time.monotonic() > self.deadline
