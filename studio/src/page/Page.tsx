// The page.
import { Dialogs } from "../panels/Dialogs";
import { Embed } from "../panels/Embed";
import { Palette } from "../panels/Palette";
import { Playback } from "../panels/Playback";
import { Printed } from "../panels/Printed";
import { Sheet } from "../panels/Sheet";
import { Side } from "../panels/Side";
import { Status } from "../panels/Status";
import { Toolbar } from "../panels/Toolbar";
import { mode } from "../store/state";

export function Page({ framed }: { framed: boolean }) {
  if (framed) return <Embed />;
  return (
    <>
      <Toolbar />
      <main class={mode.value}>
        {mode.value === "edit" ? (
          <div class="panel left">
            <Palette />
          </div>
        ) : null}
        <div class="middle">
          <Sheet />
          <Playback />
        </div>
        <Side />
      </main>
      <Status />
      <Dialogs />
      <Printed />
    </>
  );
}
