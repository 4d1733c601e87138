// Opening a picture behind the drawing.
import { backdrop } from "../store/backdrop";
import { view } from "../store/sheet";
import { announce } from "../store/state";
import { texts } from "../texts";
import { choose } from "./choose";

const OPACITY = 0.5;
/** The share of the sheet that a new picture takes. */
const SHARE = 0.8;

/** Let the user choose a picture, and show it in the middle of the sheet. */
export function openBackdrop(): void {
  choose("image/*", async (file) => {
    const image = new Image();
    image.src = URL.createObjectURL(file);
    try {
      await image.decode();
    } catch {
      announce("problem", texts.picture.unreadable(file.name));
      return;
    } finally {
      URL.revokeObjectURL(image.src);
    }
    const pixels = SHARE * Math.min(view.width / image.width, view.height / image.height);
    const center = view.toPlane([view.width / 2, view.height / 2]);
    backdrop.value = { image, center, angle: 0, scale: pixels / view.scale, opacity: OPACITY };
  });
}
