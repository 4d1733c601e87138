// The position of a time among the outputs of a run.

export interface Between {
  low: number;
  high: number;
  share: number;
}

/** The outputs before and after t, and the share of the interval before t, from 0 to 1. */
export function placeIn(times: ArrayLike<number>, t: number): Between {
  let [low, high] = [0, times.length - 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle]! <= t) low = middle;
    else high = middle;
  }
  const h = times[high]! - times[low]!;
  return { low, high, share: h > 0 ? Math.min(1, Math.max(0, (t - times[low]!) / h)) : 0 };
}

/** The number of the output nearest to t. */
export function nearest(times: ArrayLike<number>, t: number): number {
  const { low, high, share } = placeIn(times, t);
  return share < 0.5 ? low : high;
}
