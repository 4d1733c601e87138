// A text of the case in a row: its name, its input, and its unit or a button that removes it.
import { texts } from "../texts";
import { Button } from "./parts";

interface TextFieldProps {
  label: string;
  value: string;
  keep(text: string): void;
  unit?: string;
  placeholder?: string;
  hint?: string;
  onRemove?: () => void;
}

export function TextField({ label, value, keep, unit, placeholder, hint, onRemove }: TextFieldProps) {
  const id = `case-${label}`;
  return (
    <div class="field">
      <label for={id}>
        <bdi>{label}</bdi>
      </label>
      <input
        id={id}
        type="text"
        autocomplete="off"
        spellcheck={false}
        value={value}
        placeholder={placeholder ?? ""}
        title={hint}
        onChange={(event) => event.currentTarget.value !== value && keep(event.currentTarget.value)}
      />
      {onRemove ? (
        <Button label={`${texts.properties.remove} ${label}`} icon="close" kind="small" onClick={onRemove} />
      ) : (
        <span class="unit">{unit ?? ""}</span>
      )}
    </div>
  );
}
