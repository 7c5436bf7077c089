# SPDX-License-Identifier: Apache-2.0
"""Types of arrays for type checkers."""
from typing import Any

import numpy as np
from numpy.typing import NDArray

#: An array that the library reads. The functions state the element types and shapes that they accept.
Array = NDArray[Any]
#: Pictures of shape (height, width, 3) or, with alpha, (height, width, 4): uint8 without alpha, uint16, float16 or
#: float32.
Pixels = NDArray[Any]
#: Pictures of shape (height, width, 3), and maps of shape (height, width) with values from 0 to 255.
Bytes = NDArray[np.uint8]
#: Disparity maps of shape (height, width).
Floats = NDArray[np.float32]
