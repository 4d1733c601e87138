// The examples that the page contains.
import found from "virtual:examples";

export interface Example {
  name: string;
  family: string;
  title: string;
  text: string;
}

export const families = Object.keys(found);

export const examples = families.flatMap((family) =>
  Object.entries(found[family]!).map(([name, text]): Example => {
    return { name, family, title: /^title = "(.*)"/m.exec(text)?.[1] ?? name, text };
  }),
);
