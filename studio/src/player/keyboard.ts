// The keyboard. A control that has the focus keeps the keys that it needs.

const OWN_KEYS: Record<string, string[]> = {
  SELECT: ["ArrowUp", "ArrowDown", "ArrowLeft", "ArrowRight", "Home", "End", " ", "letters"],
  BUTTON: [" "],
  checkbox: [" "],
  range: ["ArrowUp", "ArrowDown", "ArrowLeft", "ArrowRight", "Home", "End"],
};

/** Call the action of each key: `{" ": () => …}`; an action gets 10 with shift, 1 without. */
export function listen(actions: Record<string, (count: number) => void>): void {
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const action = actions[event.key] ?? actions[event.key.toLowerCase()];
    if (!action || keepsKey(event.target as HTMLElement, event.key)) return;
    event.preventDefault();
    action(event.shiftKey ? 10 : 1);
  });
}

/** Whether a control needs a key. The slider of time passes its keys on, because it cannot step by frames. */
function keepsKey(control: HTMLElement, key: string): boolean {
  if (control.id === "scrub") return false;
  const own = OWN_KEYS[control instanceof HTMLInputElement ? control.type : control.tagName] ?? [];
  return own.includes(key) || (own.includes("letters") && /^[a-z]$/i.test(key));
}
