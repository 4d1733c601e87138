// The dialog that shares a case: link, QR code, frame, printed sheet, page.
import { useMemo, useState } from "preact/hooks";
import { codeOf, MOST_OF_CODE } from "../give/code";
import { savePage } from "../give/lecture";
import { frameOf, linkOf, MOST_OF_LINK } from "../give/link";
import { text, title } from "../store/state";
import { texts } from "../texts";
import { Code } from "./Code";
import { Dialog } from "./Dialog";
import { Button } from "./parts";

export function Share() {
  const words = texts.share;
  const link = useMemo(() => linkOf(text.value), [text.value]);
  return (
    <Dialog title={words.title}>
      <p>{words.text}</p>
      {link.length <= MOST_OF_LINK ? (
        <>
          {isHere() ? <p class="problem">{words.here}</p> : null}
          <Copied id="link" label={words.title} content={link} action={words.copy} done={words.copied} />
          <p class="unit">{words.length(link.length, MOST_OF_LINK)}</p>
          <h3>{words.code}</h3>
          <CodeOf link={link} />
          <h3>{words.frame}</h3>
          <p>{words.frameText}</p>
          <Copied
            id="frame"
            label={words.frame}
            content={frameOf(link, title.value || texts.untitled)}
            action={words.copyFrame}
            done={words.copiedFrame}
          />
        </>
      ) : (
        <p class="problem">{words.tooLong(link.length, MOST_OF_LINK)}</p>
      )}
      <h3>{words.sheet}</h3>
      <p>{words.sheetText}</p>
      <Button label={words.print} kind="wide" onClick={() => print()} />
      <h3>{words.pageTitle}</h3>
      <p>{words.page}</p>
      <Button label={words.savePage} kind="wide" onClick={() => savePage(title.value, text.value)} />
    </Dialog>
  );
}

/** Whether the address of this page leads nowhere on other computers. */
function isHere(): boolean {
  return !location.protocol.startsWith("http") || /^(localhost|127\.[\d.]+|\[::1\])$/.test(location.hostname);
}

function CodeOf({ link }: { link: string }) {
  const code = useMemo(() => codeOf(link), [link]);
  if (!code) return <p class="problem">{texts.share.noCode(link.length, MOST_OF_CODE)}</p>;
  return <Code code={code} />;
}

interface CopiedProps {
  id: string;
  label: string;
  content: string;
  action: string;
  done: string;
}

/** A text with a button that copies it. */
function Copied({ id, label, content, action, done }: CopiedProps) {
  const [copied, setCopied] = useState(false);
  const copy = () => void navigator.clipboard.writeText(content).then(() => setCopied(true));
  return (
    <>
      <textarea
        id={id}
        readOnly
        rows={4}
        value={content}
        aria-label={label}
        onFocus={(event) => event.currentTarget.select()}
      />
      <Button label={copied ? done : action} kind="main wide" onClick={copy} />
    </>
  );
}
