// A QR code, dark on white also if the page is dark.
import type { Code as CodeOf } from "../give/code";
import { texts } from "../texts";

export function Code({ code: { size, path } }: { code: CodeOf }) {
  return (
    <svg class="code" viewBox={`0 0 ${size} ${size}`} role="img" aria-label={texts.share.code}>
      <path d={path} />
    </svg>
  );
}
